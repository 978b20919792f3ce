#pragma once

namespace indet {

// By Boost.Math, compiled once.

/// The value below which a standard normal variable is with this probability, in (0, 1).
double normal_quantile(double probability);

/// The same of Student's t with this number of degrees of freedom, > 0.
double student_quantile(double freedom, double probability);

/// The probability that |t| of Student's law exceeds `t` ≥ 0.
double student_two_sided(double freedom, double t);

}  // namespace indet
