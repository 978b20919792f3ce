#pragma once

#include <limits>
#include <vector>

namespace indet {

/// What the polytope F of admissible states is at one value of what is varied, on the way from the packing as
/// it is to a limit. Forces and lengths in F are in mg, the unit of force of the packing as it is. Counts of
/// −1 and NaN: not known, or, of what is said of the uniform sample and of sizes, F is not bounded.
struct LimitStep {
  static constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

  double value = kNaN;  ///< the angle, multiple or factor
  int dim = -1;         ///< dim F
  int is_doubtful = 0;  ///< 1: rounding decides what F is: everything here may be wrong
  int imprecise = -1;   ///< of the 4M least and largest forces, those whose value is not certified
  int failed = -1;      ///< … and those that were not found
  int converged = -1;   ///< 0: the uniform sample stopped at its limit of sweeps
  // Over contacts; infinite where some force has no limit, NaN where one was not found.
  double mean_delta_R = kNaN, largest_delta_R = kNaN;
  double mean_delta_T = kNaN, largest_delta_T = kNaN;
  // Of states drawn uniformly from F.
  double sliding = kNaN, sliding_error = kNaN;  ///< mean M_s and its standard error
  int most_sliding = -1;                        ///< the largest M_s
  double r = kNaN, r_error = kNaN;              ///< radius [38]
  // Sizes of F.
  double inscribed_radius = kNaN;                     ///< of the largest ball inside
  double mean_width = kNaN, mean_width_error = kNaN;  ///< over all directions

  /// Nothing is left open.
  bool is_certain() const;
};

/// How files and documents call a number of a step.
template <class Number>
struct StepField {
  const char* name;
  const char* unit;
  const char* meaning;
  Number LimitStep::*member;
};
inline constexpr StepField<int> kStepCounts[] = {
    {"dim", "1", "dim F", &LimitStep::dim},
    {"doubtful", "1", "1: rounding decides what F is", &LimitStep::is_doubtful},
    {"imprecise", "1", "values of forces that are not certified", &LimitStep::imprecise},
    {"failed", "1", "values of forces that were not found", &LimitStep::failed},
    {"converged", "1", "0: the uniform sample stopped at its limit of sweeps", &LimitStep::converged},
    {"most_sliding", "1", "largest M_s in a uniform sample", &LimitStep::most_sliding}};
inline constexpr StepField<double> kStepNumbers[] = {
    {"mean_delta_R", "mg", "delta R, mean over contacts", &LimitStep::mean_delta_R},
    {"largest_delta_R", "mg", "largest delta R", &LimitStep::largest_delta_R},
    {"mean_delta_T", "mg", "delta T, mean over contacts", &LimitStep::mean_delta_T},
    {"largest_delta_T", "mg", "largest delta T", &LimitStep::largest_delta_T},
    {"sliding", "1", "mean M_s in a uniform sample", &LimitStep::sliding},
    {"sliding_error", "1", "its standard error", &LimitStep::sliding_error},
    {"r", "mg", "radius of the uniform distribution", &LimitStep::r},
    {"r_error", "mg", "its standard error", &LimitStep::r_error},
    {"inscribed_radius", "mg", "radius of the largest ball in F", &LimitStep::inscribed_radius},
    {"mean_width", "mg", "mean width of F", &LimitStep::mean_width},
    {"mean_width_error", "mg", "its standard error", &LimitStep::mean_width_error}};

/// λ_k = present + (k/n)(limit − present), k = 0 … n − 1, and one more, which is kStepBeforeLimit of the way
/// before the limit: at the limit itself F is a face without an interior, and rounding would decide about it.
/// F goes over into that face continuously, but how fast is not known: a range may fall by much on the rest.
/// Precondition: steps ≥ 1.
std::vector<double> step_values(double present, double limit, int steps);
inline constexpr double kStepBeforeLimit = 1e-4;

}  // namespace indet
