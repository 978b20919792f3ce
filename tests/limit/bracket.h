#pragma once

#include <gtest/gtest.h>

#include "libindet/limit/load_limits.h"
#include "tests/support/rational_simplex.h"

namespace indet::test {

/// Whether a packing stands, by a textbook simplex in rational numbers.
inline bool stands(const Packing& packing) { return !oracle::RationalSimplex(packing).is_empty(); }

/// A reached end is where it says: by the textbook simplex it stands a little before it, and falls a little
/// after it. `at(value)` is the packing there, `sign` the way out.
template <class At>
void expect_end(const LimitEnd& end, int sign, At at, double step) {
  ASSERT_EQ(end.outcome, LimitOutcome::kReached);
  EXPECT_LE(end.lower, end.value);
  EXPECT_LE(end.value, end.upper);
  EXPECT_TRUE(stands(at(end.value - sign * step))) << end.value;
  EXPECT_FALSE(stands(at(end.value + sign * step))) << end.value;
}

}  // namespace indet::test
