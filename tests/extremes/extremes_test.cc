#include "tests/support/extremes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "libindet/packing/validate.h"
#include "libindet/range/analyze.h"
#include "tests/support/body_variants.h"
#include "tests/support/zoo.h"

namespace indet {
namespace {

using extremes::Scene;
using extremes::Tally;

Tally judge(const Scene& scene) {
  EXPECT_FALSE(find_defect(scene.packing)) << scene.kind << ", " << scene.name;
  const Tally tally = extremes::judge(scene, analyze(scene.packing));
  for (const std::string& complaint : tally.complaints) ADD_FAILURE() << complaint;
  return tally;
}

TEST(Extremes, NoFixedSceneIsSilentlyWrong) {
  const std::vector<Scene> scenes = extremes::fixed_scenes();
  EXPECT_GE(scenes.size(), 300U);
  Tally total;
  for (const Scene& scene : scenes) total.add(judge(scene));
  EXPECT_EQ(total.wrong, 0);
  // Marks are for what exact arithmetic does not settle either.
  EXPECT_GT(total.right, 200 * (total.marked + total.contained));
}

TEST(Extremes, NoRandomSceneIsSilentlyWrong) {
  Tally total;
  for (std::uint64_t seed = 0; seed < 300; ++seed) total.add(judge(extremes::random_scene(seed, 3)));
  EXPECT_EQ(total.wrong, 0);
  EXPECT_GT(total.right, 100 * (total.marked + total.contained));
}

/// Loads by chance seldom cancel where nothing is fixed; then the scene is empty, and must be called so.
TEST(Extremes, NoSceneWithLoadedWallsIsSilentlyWrong) {
  Tally total;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Scene scene = extremes::random_scene(seed, 3);
    scene.name += ", loaded walls";
    if (seed % 3 == 0) scene.packing = zoo::with_levers(scene.packing, seed);
    scene.packing = zoo::with_loaded_walls(scene.packing, seed);
    total.add(judge(scene));
  }
  EXPECT_EQ(total.wrong, 0);
  EXPECT_GT(total.right, 100 * (total.marked + total.contained));
}

TEST(Extremes, NoSceneWithLeversOrFixedDisksIsSilentlyWrong) {
  Tally total;
  int scenes = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Scene scene = extremes::random_scene(seed, 3);
    scene.name += ", other bodies";
    if (seed % 2 == 0) scene.packing = zoo::with_fixed_disks(scene.packing, seed);
    if (seed % 4 != 0) scene.packing = zoo::with_levers(scene.packing, seed);
    if (find_defect(scene.packing)) continue;  // weights are of free disks, and these have none
    ++scenes;
    total.add(judge(scene));
  }
  EXPECT_GT(scenes, 180);
  EXPECT_EQ(total.wrong, 0);
  EXPECT_GT(total.right, 100 * (total.marked + total.contained));
}

/// A column between two walls that touch each disk: the walls can press as hard as they like, so that every
/// force grows without limit, but for the two that lift the uppermost disk: with T = X upwards at one wall
/// and Y at the other, and R = mg − X − Y from the contact below, balance of torques takes |X − Y| ≤ μ R;
/// hence X ≤ mg / 2, in the corner X = Y, for μ < 1.
TEST(Extremes, AColumnBetweenWallsIsLimitedOnlyAtItsTop) {
  const double mu = 0.3;
  for (const int count : {10, 40}) {
    const ForceRanges ranges = analyze(zoo::column_between_walls(count, mu));
    EXPECT_EQ(ranges.status, PolytopeStatus::kUnbounded);
    EXPECT_EQ(ranges.certified, ranges.objectives);
    EXPECT_EQ(ranges.unbounded, 3 * ranges.value.rows() - 2);
    const Eigen::Index left = ranges.value.rows() - 2;
    EXPECT_NEAR(ranges.value(left, kMinT), -0.5, 1e-12);  // the tangent points downwards there
    EXPECT_NEAR(ranges.value(left + 1, kMaxT), 0.5, 1e-12);
    EXPECT_LT(ranges.value.col(kMinR).cwiseAbs().maxCoeff(), 1e-12) << count;
  }
}

/// Without friction a leaning column is determined, with a closed form.
TEST(Extremes, LongColumnsHaveTheirClosedForm) {
  const double theta = 0.4;
  for (const int count : {10, 100, 1000}) {
    const ForceRanges ranges = analyze(zoo::frictionless_column(count, theta));
    ASSERT_EQ(ranges.status, PolytopeStatus::kPoint);
    EXPECT_EQ(ranges.certified, ranges.objectives);
    // Floor, then between disk k − 1 and k: (count − k) mg / cos θ.
    EXPECT_NEAR(ranges.value(0, kMaxR), count, 1e-9 * count);
    for (int k = 1; k < count; ++k)
      ASSERT_NEAR(ranges.value(k, kMinR), (count - k) / std::cos(theta), 1e-9 * count) << k;
  }
}

/// Multiplying by a power of two is exact, so nothing but the exponents may change.
TEST(Extremes, PowersOfTwoScaleBitForBit) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Packing packing = zoo::random_pile(seed, 6, -1);
    const ForceRanges plain = analyze(packing);
    for (const int exponent : {-300, -40, 1, 40, 300}) {
      const double factor = std::ldexp(1.0, exponent);
      const ForceRanges longer = analyze(zoo::rescaled(packing, factor, 1, 1));
      const ForceRanges heavier = analyze(zoo::rescaled(packing, 1, 1, factor));
      for (Eigen::Index i = 0; i < plain.value.rows(); ++i) {
        for (int column = 0; column < 4; ++column) {
          const auto same = [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); };
          EXPECT_TRUE(same(longer.value(i, column), plain.value(i, column)));
          EXPECT_TRUE(same(heavier.value(i, column), factor * plain.value(i, column)));
          EXPECT_TRUE(same(heavier.lower(i, column), factor * plain.lower(i, column)));
          EXPECT_TRUE(same(heavier.upper(i, column), factor * plain.upper(i, column)));
          EXPECT_EQ(heavier.outcome(i, column), plain.outcome(i, column));
        }
      }
    }
  }
}

TEST(Extremes, NoOtherMethodIsSilentlyWrong) {
  Tally total;
  const std::vector<Scene> scenes = extremes::fixed_scenes();
  for (std::size_t number = 0; number < scenes.size(); number += 4) {
    const extremes::Judge judge(scenes[number]);
    for (const Method method : {Method::kPivotingTableau, Method::kPivotingPaper}) {
      AnalyzeOptions options;
      options.method = method;
      const Tally tally = judge.judge(analyze(scenes[number].packing, options));
      for (const std::string& complaint : tally.complaints)
        ADD_FAILURE() << to_string(method) << ": " << complaint;
      total.add(tally);
    }
  }
  EXPECT_EQ(total.wrong, 0);
  EXPECT_GT(total.right, total.marked + total.contained);
}

/// A basis so ill-conditioned that factorising it anew does not help: the walk must give up, not try for
/// ever.
TEST(Extremes, TheTableauGivesUpWhereFactorisingDoesNotHelp) {
  const Scene scene = extremes::random_scene(820, 3);
  AnalyzeOptions options;
  options.method = Method::kPivotingTableau;
  const Tally tally = extremes::judge(scene, analyze(scene.packing, options));
  EXPECT_EQ(tally.wrong, 0);
  EXPECT_GT(tally.right + tally.contained + tally.marked, 0);
}

TEST(Extremes, TheJudgeSeesAWrongNumberAndAMissedBound) {
  const Scene scene{"wedge", "as it is", extremes::fixed_scenes().front().packing};
  const ForceRanges right = analyze(scene.packing);
  EXPECT_EQ(extremes::judge(scene, right).right, 8);

  ForceRanges wrong = right;
  wrong.value(0, kMaxR) *= 1.001;
  EXPECT_EQ(extremes::judge(scene, wrong).contained, 1);
  wrong.lower(0, kMaxR) = wrong.value(0, kMaxR);
  wrong.upper(0, kMaxR) = wrong.value(0, kMaxR);
  EXPECT_EQ(extremes::judge(scene, wrong).wrong, 1);
  wrong.outcome(0, kMaxR) = Outcome::kImprecise;
  EXPECT_EQ(extremes::judge(scene, wrong).marked, 1);
  ForceRanges unbounded = right;
  unbounded.value(1, kMinT) = -INFINITY;
  EXPECT_EQ(extremes::judge(scene, unbounded).wrong, 1);
  ForceRanges empty = right;
  empty.status = PolytopeStatus::kEmpty;
  EXPECT_EQ(extremes::judge(scene, empty).wrong, 1);
}

}  // namespace
}  // namespace indet
