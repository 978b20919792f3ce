#include "libindet/range/exact_ranges.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "libindet/range/analyze.h"
#include "libindet/verify/verify.h"
#include "tests/support/extremes.h"
#include "tests/support/rational_simplex.h"
#include "tests/support/zoo.h"
#include "tests/verify/exact_values.h"

namespace indet {
namespace {

using Exactness = AnalyzeOptions::Exactness;

AnalyzeOptions options_with(Exactness exactness) {
  AnalyzeOptions options;
  options.exactness = exactness;
  return options;
}

void expect_verified(const Packing& packing, const ForceRanges& ranges) {
  const Verification again = verify_ranges(packing, ranges);
  EXPECT_TRUE(again.passed()) << (again.messages.empty() ? "" : again.messages.front());
}

TEST(ExactRanges, AreTheExactValuesRoundedOnce) {
  int standing = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const extremes::Scene scene = extremes::random_scene(seed, 3);
    SCOPED_TRACE(scene.kind + ", " + scene.name);
    const ForceRanges ranges = analyze(scene.packing, options_with(Exactness::kEverywhere));
    oracle::RationalSimplex exact(scene.packing);
    ASSERT_EQ(ranges.status == PolytopeStatus::kEmpty, exact.is_empty());
    EXPECT_TRUE(ranges.exact);
    EXPECT_FALSE(ranges.doubtful);
    expect_verified(scene.packing, ranges);
    if (exact.is_empty()) continue;
    EXPECT_EQ(ranges.rank, exact.rank());
    ++standing;
    EXPECT_EQ(ranges.certified, ranges.objectives);
    expect_exact_values(scene.packing, ranges, exact);
    const Reactions& reactions = ranges.reactions;
    EXPECT_EQ(reactions.certified(), 2 * reactions.count());
    EXPECT_TRUE((reactions.lower <= reactions.value && reactions.value <= reactions.upper).all());
  }
  EXPECT_GT(standing, 20);
}

/// What is asked for everywhere and what is found in double precision agree where that is in no doubt: the
/// polytope, the values within their enclosures, and canonical states.
TEST(ExactRanges, AgreeWithDoublePrecisionWhereThatSuffices) {
  for (const auto& [name, packing] : std::vector<std::pair<std::string, Packing>>{
           {"pile", zoo::random_pile(101, 8, 0.5)},
           {"lattice", zoo::lattice_pile(3, 0.6)},
           {"column between walls", zoo::column_between_walls(4, 0.3)},
           {"two blocks", zoo::wedge_and_corner(0.5, 0.4)}}) {
    SCOPED_TRACE(name);
    const ForceRanges doubles = analyze(packing, options_with(Exactness::kNowhere));
    const ForceRanges exact = analyze(packing, options_with(Exactness::kEverywhere));
    ASSERT_FALSE(doubles.doubtful);
    ASSERT_TRUE(exact.exact);
    EXPECT_EQ(doubles.status, exact.status);
    EXPECT_EQ(doubles.rank, exact.rank);
    EXPECT_EQ(doubles.nullity, exact.nullity);
    EXPECT_EQ(doubles.dim, exact.dim);
    EXPECT_EQ(doubles.blocks, exact.blocks);
    EXPECT_EQ(doubles.determined, exact.determined);
    EXPECT_TRUE((doubles.unique == exact.unique).all());
    for (int i = 0; i < packing.contact_count(); ++i) {
      for (int column = 0; column < 4; ++column) {
        SCOPED_TRACE(std::to_string(i) + " " + to_string(static_cast<Column>(column)));
        EXPECT_LE(doubles.lower(i, column), exact.lower(i, column));
        EXPECT_GE(doubles.upper(i, column), exact.upper(i, column));
        const auto first = doubles.vertex(i, column);
        const auto second = exact.vertex(i, column);
        ASSERT_EQ(first < 0, second < 0);
        if (first < 0) continue;
        EXPECT_LT((doubles.states.row(first) - exact.states.row(second)).norm(),
                  1e-9 * (1 + exact.states.row(second).norm()));
      }
    }
  }
}

/// Scenes about which double precision cannot decide: exact arithmetic does, and what is stored is verified.
TEST(ExactRanges, DecideWhatDoublePrecisionLeavesInDoubt) {
  int in_doubt = 0;
  int left = 0;
  int exact = 0;
  int number = 0;
  for (const extremes::Scene& scene : extremes::fixed_scenes()) {
    if (++number % 4 != 0) continue;
    const ForceRanges doubles = analyze(scene.packing, options_with(Exactness::kNowhere));
    if (!doubles.doubtful && doubles.imprecise + doubles.failed == 0) continue;
    SCOPED_TRACE(scene.kind + ", " + scene.name);
    ++in_doubt;
    const ForceRanges settled = analyze(scene.packing);
    left += settled.doubtful || settled.imprecise + settled.failed > 0 ? 1 : 0;
    exact += settled.exact ? 1 : 0;
    expect_verified(scene.packing, settled);
  }
  EXPECT_GT(in_doubt, 30);
  EXPECT_EQ(left, 0);
  EXPECT_GT(exact, 10);
}

TEST(ExactRanges, AreNotSoughtBeyondTheLimitOfWork) {
  const Packing packing = zoo::wedge(1e-15, 0.5);
  AnalyzeOptions options;
  options.exact_work = 1;
  EXPECT_TRUE(analyze(packing, options).doubtful);
  const ForceRanges settled = analyze(packing);
  EXPECT_TRUE(settled.exact);
  EXPECT_FALSE(settled.doubtful);
  EXPECT_FALSE(std::isnan(settled.hairline));
  EXPECT_LT(settled.hairline, 1e-9);
}

TEST(ExactRanges, DoNotDependOnTheNumberOfThreads) {
  const Packing packing = zoo::random_pile(101, 8, 0.5);
  AnalyzeOptions options = options_with(Exactness::kEverywhere);
  const ForceRanges one = analyze(packing, options);
  options.threads = 3;
  const ForceRanges three = analyze(packing, options);
  EXPECT_EQ(one.states, three.states);
  EXPECT_TRUE((one.vertex == three.vertex).all());
  EXPECT_TRUE((one.lower == three.lower && one.upper == three.upper).all());
}

/// Seven pipes in a hexagonal band: the extremal rays of the ideal array are none of the rounded one.
TEST(ExactRanges, AreNotNeededForConfinedRegularArrays) {
  Packing packing;
  packing.gravity = {0, -1};
  packing.disks.resize(7);
  packing.walls.resize(6);
  const double pi = std::acos(-1.0);
  const auto contact = [&](int a, Body b, double angle) {
    Contact c;
    c.a = DiskId(a);
    c.b = b;
    c.normal = {std::cos(angle), std::sin(angle)};
    c.mu = 0.3;
    packing.contacts.push_back(c);
  };
  for (int i = 0; i < 7; ++i) {
    Disk& disk = packing.disks[static_cast<std::size_t>(i)];
    disk.id = i;
    disk.radius = disk.mass = 1;
    const double angle = (i - 1) * pi / 3;
    if (i > 0) disk.position = {2 * std::cos(angle), 2 * std::sin(angle)};
  }
  for (int w = 0; w < 6; ++w) {
    Wall& wall = packing.walls[static_cast<std::size_t>(w)];
    wall.id = w;
    const double angle = pi / 6 + w * pi / 3;
    wall.normal = {-std::cos(angle), -std::sin(angle)};
    wall.point = -(std::sqrt(3.0) + 1) * wall.normal;
    const double next = w * pi / 3;  // of disk w + 1
    contact(w + 1, Body::disk(DiskId(0)), next);
    contact((w + 1) % 6 + 1, Body::disk(DiskId(w + 1)), next + 2 * pi / 3);
    contact(w + 1, Body::wall(WallId(w)), angle + pi);
    contact((w + 1) % 6 + 1, Body::wall(WallId(w)), angle + pi);
  }
  const ForceRanges ranges = analyze(packing, options_with(Exactness::kNowhere));
  EXPECT_EQ(ranges.status, PolytopeStatus::kUnbounded);
  EXPECT_FALSE(ranges.doubtful);
  EXPECT_EQ(ranges.certified, 96);
  EXPECT_EQ(ranges.unbounded, 72);
  expect_verified(packing, ranges);
}

}  // namespace
}  // namespace indet
