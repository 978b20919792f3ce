#include "libindet/range/enclosure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <optional>
#include <vector>

#include "libindet/exact/optimum.h"
#include "libindet/polytope/central_polytope.h"
#include "libindet/range/analyze.h"
#include "libindet/range/extrema.h"
#include "tests/support/body_variants.h"
#include "tests/support/rational_simplex.h"
#include "tests/support/zoo.h"

namespace indet {
namespace {

constexpr double kNarrow = 1e-12;

/// How many values there were, and how many of them had no narrow enclosure.
struct Seen {
  int values = 0, wide = 0;
};

/// Compares what double precision encloses with the textbook simplex in rational numbers.
void expect_exact_optimum_within(const Packing& packing, bool by_centre, Seen& seen) {
  ForcePolytope polytope = find_force_polytope(packing);
  if (polytope.status == PolytopeStatus::kEmpty || polytope.doubtful) return;
  if (by_centre && !add_centre(polytope)) return;
  std::vector<int> contacts(packing.contacts.size());
  std::iota(contacts.begin(), contacts.end(), 0);
  const Extrema extrema = find_extrema(packing, polytope, contacts, {}, {});
  const Enclosures enclosures = enclose_values(polytope, extrema);
  ASSERT_TRUE(enclosures.proven);
  oracle::RationalSimplex exact(packing);
  for (Eigen::Index i = 0; i < extrema.value.rows(); ++i) {
    for (int column = 0; column < 4; ++column) {
      if (extrema.claim(i, column) != Outcome::kOptimal) continue;
      SCOPED_TRACE(::testing::Message() << "contact " << i << ", column " << column);
      const int component = static_cast<int>(2 * i) + (column >= kMinT ? 1 : 0);
      const std::optional<mpq_class> value =
          exact.extremum(component, column == kMaxR || column == kMaxT ? 1 : -1);
      ASSERT_TRUE(value);
      const double lower = enclosures.lower(i, column), upper = enclosures.upper(i, column);
      EXPECT_TRUE(exact::contains({lower, upper}, *value)) << lower << " " << upper;
      EXPECT_LE(lower, extrema.value(i, column));
      EXPECT_GE(upper, extrema.value(i, column));
      ++seen.values;
      const double size = std::max(packing.force_unit(), std::abs(extrema.value(i, column)));
      const bool is_narrow = upper - lower <= kNarrow * size;
      EXPECT_TRUE(is_narrow || polytope.status == PolytopeStatus::kUnbounded) << upper - lower;
      seen.wide += is_narrow ? 0 : 1;
    }
  }
}

TEST(Enclosures, AreNarrowAroundTheExactOptimum) {
  for (const bool by_centre : {false, true}) {
    Seen seen;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
      SCOPED_TRACE(seed);
      expect_exact_optimum_within(zoo::random_pile(seed, 4, seed % 2 == 0 ? -1 : 0.6), by_centre, seen);
    }
    EXPECT_GE(seen.values, 300);
  }
}

/// Where disks can be jammed, no bound of all strengths helps from outside.
TEST(Enclosures, AreNarrowWhereOneRowCanBePressed) {
  Seen seen;
  expect_exact_optimum_within(zoo::wedge(0.7, 1.5), false, seen);
  expect_exact_optimum_within(zoo::row_between_walls(3, 0.5), false, seen);
  expect_exact_optimum_within(zoo::row_between_walls(6, 0.3), false, seen);
  expect_exact_optimum_within(zoo::column_between_walls(3, 0.5), false, seen);
  expect_exact_optimum_within(zoo::pinched_disk(0.5), false, seen);
  expect_exact_optimum_within(zoo::lattice_between_walls(3, 0.5), false, seen);
  EXPECT_GE(seen.values, 100);
  EXPECT_LE(seen.wide, 3) << "where rays differ, they are left to the barrier method";
}

TEST(Enclosures, HaveTwoEndsWhereForcesAreUnbounded) {
  Seen seen;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    expect_exact_optimum_within(zoo::random_pile(seed, 5, 1.2), false, seen);
  }
  EXPECT_GE(seen.values, 200);
  EXPECT_LE(5 * seen.wide, seen.values) << "the rest is left to the barrier method";
}

TEST(Enclosures, LeaveNoValueOfAConfinedLatticeInDoubt) {
  const ForceRanges ranges = analyze(zoo::lattice_between_walls(6, 0.5));
  EXPECT_EQ(ranges.certified, 212);
  EXPECT_EQ(ranges.imprecise, 0);
  EXPECT_EQ(ranges.reactions.uncertain(), 0);
}

/// Equations of levers, of loaded walls and of stress have entries that are no doubles.
TEST(Enclosures, HoldTheExactOptimumWithLeversAndLoadedWalls) {
  Seen seen;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    const Packing pile = zoo::with_levers(zoo::random_pile(seed, 4, -1), seed);
    expect_exact_optimum_within(pile, false, seen);
    expect_exact_optimum_within(zoo::with_loaded_walls(pile, seed), false, seen);
  }
  EXPECT_GE(seen.values, 200);
}

}  // namespace
}  // namespace indet
