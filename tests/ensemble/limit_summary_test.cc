#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "apps/ensemble/presentation/limit_figures.h"

namespace indet {
namespace {

using Row = std::vector<std::string>;

/// Three seeds of CD-1 and MD-1.
EnsembleTables some_packings() {
  EnsembleTables tables;
  for (const sim::Protocol protocol : {sim::Protocol::kCd1, sim::Protocol::kMd1}) {
    for (const int seed : {0, 1, 2}) {
      const std::size_t run = tables.runs.rows();
      tables.runs.add_rows(1);
      tables.runs.set("protocol", run, std::string(to_string(protocol)));
      tables.runs.set("seed", run, seed);
    }
  }
  return tables;
}

Row row_of(const EnsembleTables& tables, const std::string& name) {
  for (const Row& row : limit_summary(tables)) {
    if (row.front().starts_with(name)) return row;
  }
  return {};
}

TEST(LimitSummary, IsEmptyWithoutLimits) {
  EXPECT_TRUE(limit_summary(some_packings()).empty());
  EXPECT_TRUE(limit_figures(some_packings()).empty());
}

TEST(LimitSummary, ComparesPackingsOfOneSeed) {
  EnsembleTables tables = some_packings();
  // They differ much between seeds, and by 0.1, 0.1 and 0.13 between the methods.
  const double cd[] = {0.5, 0.7, 0.9};
  const double md[] = {0.4, 0.6, 0.77};
  for (std::size_t seed = 0; seed < 3; ++seed) {
    tables.runs.set("least_friction", seed, cd[seed]);
    tables.runs.set("least_friction", 3 + seed, md[seed]);
    tables.runs.set("load_on_top", seed, 10 * cd[seed]);
    tables.runs.set("load_on_top", 3 + seed, 10 * cd[seed] + (seed == 0 ? 1 : -1));
  }
  EXPECT_EQ(limit_summary(tables).front(), (Row{"", "CD-1", "MD-1", "CD − MD", "more stable"}));
  EXPECT_EQ(row_of(tables, "least friction"), (Row{"least friction (of the coefficient)", "0.700 ± 0.115",
                                                   "0.590 ± 0.107", "0.110 ± 0.010", "MD"}));
  EXPECT_EQ(row_of(tables, "largest load").back(), "not decided");
  EXPECT_EQ(row_of(tables, "packings whose")[1], "0 of 3") << "no tilt is known";
}

TEST(LimitSummary, CountsPackingsWithoutLimit) {
  EnsembleTables tables = some_packings();
  tables.runs.set("load_on_top", 0, 3.0);
  tables.runs.set("load_on_top", 1, std::numeric_limits<double>::infinity());
  tables.runs.set("load_on_top", 2, 5.0);
  EXPECT_EQ(row_of(tables, "largest load")[1], "4.0 ± 1.0, 1 without limit");
}

TEST(LimitSummary, TakesTheSmallerOfBothWaysWithItsState) {
  EnsembleTables tables = some_packings();
  const double degree = std::numbers::pi / 180;
  tables.runs.set("tilt_of_several_smallest", 0, -2 * degree);
  tables.runs.set("tilt_of_several_largest", 0, 5 * degree);
  tables.runs.set("tilt_of_several_smallest_dim", 0, 30);
  tables.runs.set("tilt_of_several_largest_dim", 0, 10);
  tables.runs.set("tilt_of_several_smallest", 1, -8 * degree);
  tables.runs.set("tilt_of_several_largest", 1, 4 * degree);
  tables.runs.set("tilt_of_several_smallest_dim", 1, 10);
  tables.runs.set("tilt_of_several_largest_dim", 1, 20);
  for (const std::size_t run : {0, 1}) {
    tables.runs.set("tilt_of_several_lower_bound", run, 40);
    tables.runs.set("tilt_smallest", run, -1 * degree);
    tables.runs.set("tilt_largest", run, 1 * degree);
  }
  EXPECT_EQ(row_of(tables, "tilt at which several")[1], "3.00 ± 1.00");
  EXPECT_EQ(row_of(tables, "dim F left there / ")[1], "0.625 ± 0.125");
  EXPECT_EQ(limit_figures(tables).size(), 3);
}

}  // namespace
}  // namespace indet
