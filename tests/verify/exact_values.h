#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "libindet/packing/packing.h"
#include "libindet/range/force_ranges.h"
#include "tests/support/rational_simplex.h"

namespace indet {

/// Each value is the exact one, between two neighbouring doubles, or infinite.
inline void expect_exact_values(const Packing& packing, const ForceRanges& ranges,
                                oracle::RationalSimplex& exact) {
  for (int i = 0; i < packing.contact_count(); ++i) {
    for (int column = 0; column < 4; ++column) {
      const auto value = exact.extremum(2 * i + (column >= kMinT ? 1 : 0), column % 2 == 0 ? -1 : 1);
      const double stored = ranges.value(i, column);
      if (!value) {
        EXPECT_TRUE(std::isinf(stored));
        continue;
      }
      EXPECT_LE(mpq_class(ranges.lower(i, column)), *value);
      EXPECT_GE(mpq_class(ranges.upper(i, column)), *value);
      EXPECT_LE(ranges.upper(i, column), std::nextafter(ranges.lower(i, column), INFINITY));
      EXPECT_LE(ranges.lower(i, column), stored);
      EXPECT_GE(ranges.upper(i, column), stored);
    }
  }
}

}  // namespace indet
