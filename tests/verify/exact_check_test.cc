#include "libindet/verify/exact_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "libindet/range/analyze.h"
#include "libindet/range/reactions.h"
#include "libindet/verify/verify.h"
#include "tests/support/body_variants.h"
#include "tests/support/extremes.h"
#include "tests/support/rational_simplex.h"
#include "tests/support/zoo.h"
#include "tests/verify/exact_values.h"

namespace indet {
namespace {

TEST(ExactCheck, ProvesAllObjectivesOfAPile) {
  const Packing packing = zoo::random_pile(101, 12, 0.5);  // one of the piles that stand
  const ForceRanges ranges = analyze(packing);
  ASSERT_NE(ranges.status, PolytopeStatus::kEmpty);
  const ExactCheck check = check_exactly(packing, ranges);
  EXPECT_TRUE(check.passed()) << (check.messages.empty() ? "" : check.messages.front());
  EXPECT_EQ(check.proven + check.repaired, 4 * packing.contact_count() + 2 * ranges.reactions.count());
  EXPECT_EQ(check.rank, ranges.rank);
  EXPECT_LT(check.worst_error, 1e-10);
  ExactCheckOptions two;
  two.threads = 2;
  EXPECT_EQ((check.lower == check_exactly(packing, ranges, two).lower).all(), true);
}

TEST(ExactCheck, NeedsNoRationalNumbersForMost) {
  const Packing packing = zoo::random_pile(105, 12, 0.5);
  const ExactCheck check = check_exactly(packing, analyze(packing));
  EXPECT_TRUE(check.passed());
  EXPECT_GT(check.rational, 0)
      << "R of a disk on the floor is its weight, a double, to which no enclosure shrinks";
  EXPECT_LT(check.rational, check.proven / 10);
}

TEST(ExactCheck, ProvesAllObjectivesWithLeversAndFixedDisks) {
  int standing = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const Packing packing =
        zoo::with_levers(zoo::with_fixed_disks(zoo::random_pile(seed, 8, 0.6), seed), seed);
    const ForceRanges ranges = analyze(packing);
    const ExactCheck check = check_exactly(packing, ranges);
    EXPECT_TRUE(check.passed()) << seed << ": " << (check.messages.empty() ? "" : check.messages.front());
    EXPECT_EQ(check.rank, ranges.rank);
    if (ranges.status == PolytopeStatus::kEmpty) {
      EXPECT_TRUE(check.proves_emptiness) << seed;
      continue;
    }
    ++standing;
    EXPECT_EQ(check.proven + check.repaired, 4 * packing.contact_count() + 2 * ranges.reactions.count());
    EXPECT_LT(check.worst_error, 1e-10);
  }
  EXPECT_GT(standing, 2);
}

TEST(ExactCheck, RepairsAWrongStateAndReportsAWrongBound) {
  const Packing packing = zoo::wedge(0.5, 0.3);
  ForceRanges wrong = analyze(packing);
  wrong.vertex(0, kMaxR) = wrong.vertex(0, kMinR);
  ExactCheck check = check_exactly(packing, wrong);
  EXPECT_EQ(check.repaired, 1);
  EXPECT_GT(check.pivots, 0);
  EXPECT_TRUE(check.passed());
  wrong.upper(0, kMaxR) = wrong.lower(0, kMaxR) = wrong.value(0, kMaxR) = wrong.value(0, kMinR);
  check = check_exactly(packing, wrong);
  EXPECT_EQ(check.contradictions, 1);
  EXPECT_FALSE(check.passed());
  EXPECT_NEAR(check.worst_error, zoo::wedge_ranges(0.5, 0.3).delta_R, 1e-12);
}

TEST(ExactCheck, ProvesReactionsAndReportsWrongOnes) {
  const Packing packing = zoo::disks_between_plates(3, 2.5, 0.3);
  const ForceRanges ranges = analyze(packing);
  ExactCheck check = check_exactly(packing, ranges);
  EXPECT_TRUE(check.passed());
  EXPECT_EQ(check.reactions.value(0, 0), 5.5) << "ΣR of the floor: three weights and the load, exactly";
  EXPECT_EQ(check.reactions.lower(0, 1), 5.5);
  EXPECT_EQ(check.reactions.upper(2, 1), 2.5);
  ForceRanges wrong = ranges;
  wrong.reactions.value(0, 1) = wrong.reactions.lower(0, 1) = wrong.reactions.upper(0, 1) = 5.75;
  check = check_exactly(packing, wrong);
  EXPECT_EQ(check.contradictions, 1);
  EXPECT_EQ(check.worst_error, 0.25);
  wrong = ranges;
  wrong.reactions.value(1, 1) = wrong.reactions.upper(1, 1) = INFINITY;
  EXPECT_EQ(check_exactly(packing, wrong).refuted, 1);
  wrong = ranges;
  wrong.reactions.component[1] = 0;
  EXPECT_EQ(check_exactly(packing, wrong).contradictions, 1);
}

/// The sums of piles on walls and fixed disks, against a simplex method in rational numbers.
TEST(ExactCheck, ReactionsAreThoseOfAnotherExactMethod) {
  int standing = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const Packing packing =
        zoo::with_levers(zoo::with_fixed_disks(zoo::random_pile(seed, 4, 0.6), seed), seed);
    const ForceRanges ranges = analyze(packing);
    if (ranges.status == PolytopeStatus::kEmpty) continue;
    ++standing;
    const ExactCheck check = check_exactly(packing, ranges);
    oracle::RationalSimplex exact(packing);
    const std::vector<ReactionSum> sums = reaction_sums(packing);
    ASSERT_EQ(std::ssize(sums), ranges.reactions.count());
    for (Eigen::Index k = 0; k < ranges.reactions.count(); ++k) {
      std::vector<std::pair<int, double>> terms;
      const Eigen::VectorXd& coefficients = sums[static_cast<std::size_t>(k)].coefficients;
      for (int i = 0; i < coefficients.size(); ++i) terms.emplace_back(i, coefficients[i]);
      for (const int end : {0, 1}) {
        const auto value = exact.extremum(terms, end == 0 ? -1 : 1);
        if (!value) {
          EXPECT_TRUE(std::isinf(check.reactions.value(k, end)));
          continue;
        }
        EXPECT_LE(mpq_class(check.reactions.lower(k, end)), *value);
        EXPECT_GE(mpq_class(check.reactions.upper(k, end)), *value);
        EXPECT_LE(check.reactions.upper(k, end), std::nextafter(check.reactions.lower(k, end), INFINITY));
        const double lower = ranges.reactions.lower(k, end);
        const double upper = ranges.reactions.upper(k, end);
        EXPECT_TRUE(lower == -INFINITY || mpq_class(lower) <= *value);
        EXPECT_TRUE(upper == INFINITY || mpq_class(upper) >= *value);
      }
    }
  }
  EXPECT_GT(standing, 2);
}

TEST(ExactCheck, TellsUnboundedFromFinite) {
  const Packing packing = zoo::pinched_disk(0.4);
  ForceRanges ranges = analyze(packing);
  EXPECT_EQ(check_exactly(packing, ranges).proven, 8 + 8) << "ΣR and ΣT of two walls";
  ranges.value(0, kMinR) = -INFINITY;
  EXPECT_EQ(check_exactly(packing, ranges).refuted, 1);
  ranges = analyze(packing);
  ranges.value(0, kMaxR) = ranges.lower(0, kMaxR) = ranges.upper(0, kMaxR) = 7;
  ranges.vertex(0, kMaxR) = 0;
  ranges.outcome(0, kMaxR) = Outcome::kOptimal;
  const ExactCheck check = check_exactly(packing, ranges);
  EXPECT_EQ(check.refuted, 1);
  EXPECT_EQ(check.contradictions, 1);
}

TEST(ExactCheck, ProvesThatAPackingCannotStand) {
  for (const Packing& packing :
       {zoo::disk_on_incline(0.2, 1), zoo::pyramid(0.7, 0.2, 0.5), zoo::spun_wedge(0.6, 0.3, 2)}) {
    const ForceRanges ranges = analyze(packing);
    ASSERT_EQ(ranges.status, PolytopeStatus::kEmpty);
    EXPECT_FALSE(ranges.doubtful);
    const ExactCheck check = check_exactly(packing, ranges);
    EXPECT_TRUE(check.proves_emptiness);
    EXPECT_TRUE(check.passed());
  }
  ForceRanges forged = analyze(zoo::disk_on_incline(0.2, 1));
  const ExactCheck check = check_exactly(zoo::wedge(0.5, 0.3), forged);
  EXPECT_FALSE(check.proves_emptiness);
  EXPECT_EQ(check.refuted, 1);
}

TEST(ExactCheck, SaysThatTheRankDiffers) {
  // Normals that differ by 1e-15: in doubles one direction, exactly two.
  const Packing packing = zoo::wedge(1e-15, 0.3);
  AnalyzeOptions options;
  options.exactness = AnalyzeOptions::Exactness::kNowhere;
  const ForceRanges ranges = analyze(packing, options);
  EXPECT_TRUE(ranges.doubtful);
  const ExactCheck check = check_exactly(packing, ranges);
  EXPECT_EQ(ranges.rank, 2);
  EXPECT_EQ(check.rank, 3);
  ASSERT_FALSE(check.messages.empty());
  EXPECT_NE(check.messages.front().find("rank differs"), std::string::npos);
}

TEST(AdoptExact, StoresTheExactValuesRoundedOnce) {
  int scenes = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const extremes::Scene scene = extremes::random_scene(seed, 3);
    SCOPED_TRACE(scene.kind + ", " + scene.name);
    ForceRanges ranges = analyze(scene.packing);
    if (ranges.status == PolytopeStatus::kEmpty || ranges.doubtful) continue;
    const ExactCheck check = check_exactly(scene.packing, ranges);
    EXPECT_TRUE(check.passed());
    ranges = adopt_exact(scene.packing, check, ranges);
    EXPECT_EQ(ranges.certified, ranges.objectives);
    oracle::RationalSimplex exact(scene.packing);
    expect_exact_values(scene.packing, ranges, exact);
    const Reactions& reactions = ranges.reactions;
    EXPECT_EQ(reactions.certified(), 2 * reactions.count());
    EXPECT_TRUE((reactions.lower <= reactions.value && reactions.value <= reactions.upper).all());
    const Verification again = verify_ranges(scene.packing, ranges);
    EXPECT_TRUE(again.passed()) << (again.messages.empty() ? "" : again.messages.front());
    ++scenes;
  }
  EXPECT_GT(scenes, 20);
}

}  // namespace
}  // namespace indet
