#pragma once

#include <gmpxx.h>

namespace indet::exact {

/// The two neighbouring doubles that enclose a rational number; equal if it is one.
struct Enclosure {
  double lower = 0;
  double upper = 0;
};
Enclosure enclose(const mpq_class& value);
/// Whether bounds, which may be infinite, hold; NaN holds nothing.
bool contains(const Enclosure& bounds, const mpq_class& value);
/// The nearer of the two; the finite one where the number is too large for a double.
double nearest(const mpq_class& value);

}  // namespace indet::exact
