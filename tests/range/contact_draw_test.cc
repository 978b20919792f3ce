#include "libindet/range/contact_draw.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "libindet/range/analyze.h"
#include "libindet/statistics/draw_estimate.h"
#include "tests/support/compare.h"
#include "tests/support/zoo.h"

namespace indet {
namespace {

using Widths = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;

Widths widths(std::initializer_list<std::pair<double, double>> rows) {
  Widths result(static_cast<Eigen::Index>(rows.size()), 2);
  Eigen::Index i = 0;
  for (const auto& [R, T] : rows) result.row(i++) << R, T;
  return result;
}

ForceRanges sample_by_barrier(const Packing& packing, int draws, std::uint64_t seed, int threads = 1) {
  AnalyzeOptions options;
  options.method = Method::kBarrier;
  options.contacts = {ContactChoice::Kind::kSample, draws, seed, {}};
  options.threads = threads;
  return analyze(packing, options);
}

TEST(ContactDraw, WeightsFollowBothWidths) {
  // Means 2 and 1.
  EXPECT_EQ(draw_weights(widths({{1, 0.5}, {3, 1.5}, {0, 0}, {4, 2}})),
            (std::vector<std::int32_t>{102, 302, 2, 402}));
  // In any unit of force; without friction R alone counts; where nothing can vary all are equally likely.
  EXPECT_EQ(draw_weights(1e-20 * widths({{1, 0.5}, {3, 1.5}, {0, 0}, {4, 2}})),
            (std::vector<std::int32_t>{102, 302, 2, 402}));
  EXPECT_EQ(draw_weights(widths({{1, 0}, {3, 0}})), (std::vector<std::int32_t>{52, 152}));
  EXPECT_EQ(draw_weights(widths({{0, 0}, {0, 0}})), (std::vector<std::int32_t>{2, 2}));
}

TEST(ContactDraw, LastDigitsOfWidthsDoNotMatter) {
  const Widths about = widths({{1, 0.4}, {3, 1.7}, {0.01, 0.02}, {4, 2}});
  const std::vector<std::int32_t> weights = draw_weights(about);
  EXPECT_EQ(draw_weights(about * (1 + 1e-9)), weights);
  EXPECT_EQ(draw_weights(about.array() + 1e-9), weights);
}

TEST(ContactDraw, DrawsInProportionToWeights) {
  const std::vector<std::int32_t> weight = {2, 100, 300, 48};
  constexpr int kDraws = 90000;
  const std::vector<std::int32_t> drawn = draw_with_replacement(weight, kDraws, 3);
  int sum = 0;
  for (std::size_t i = 0; i < weight.size(); ++i) {
    const double expected = kDraws * weight[i] / 450.0;
    EXPECT_NEAR(drawn[i], expected, 5 * std::sqrt(expected));
    sum += drawn[i];
  }
  EXPECT_EQ(sum, kDraws);
  EXPECT_EQ(draw_with_replacement(weight, 7, 3), draw_with_replacement(weight, 7, 3));
  EXPECT_NE(draw_with_replacement(weight, 70, 3), draw_with_replacement(weight, 70, 4));
  // These are the numbers of the generator on any machine.
  EXPECT_EQ(draw_with_replacement({1, 1, 1, 1}, 8, 1), (std::vector<std::int32_t>{2, 1, 2, 3}));
}

/// One dimension: both widths of a contact stand in the ratio of its ranges.
TEST(ContactDraw, WidthsAreThoseOfTheEllipsoidAboutTheCentre) {
  const Packing packing = zoo::wedge(0.6, 0.3);
  const ForceRanges ranges = sample_by_barrier(packing, 1, 1);
  ASSERT_EQ(ranges.draws, 1);
  ASSERT_EQ(ranges.dim, 1);
  const ForceRanges all = analyze(packing);
  for (Eigen::Index i = 0; i < 2; ++i) {
    EXPECT_NEAR(ranges.width(i, 1) / ranges.width(i, 0), all.delta_T[i] / all.delta_R[i], 1e-9);
    EXPECT_LT(2 * ranges.width(i, 0), all.delta_R[i] * ranges.force_unit);
    EXPECT_GT(ranges.centre(i, 0), all.value(i, kMinR));
    EXPECT_LT(ranges.centre(i, 0), all.value(i, kMaxR));
  }
}

TEST(ContactDraw, OnlyDrawnContactsAreAnalyzed) {
  const Packing packing = zoo::column(12, 0.3, 0.5);
  const ForceRanges ranges = sample_by_barrier(packing, 15, 5);
  ASSERT_EQ(ranges.draws, 15);
  EXPECT_EQ(ranges.drawn.sum(), 15);
  EXPECT_EQ((ranges.drawn > 0).count(), ranges.requested);
  EXPECT_EQ(ranges.objectives, 4 * ranges.requested);
  std::vector<DrawnValue> values;
  for (Eigen::Index i = 0; i < ranges.drawn.size(); ++i) {
    EXPECT_EQ(ranges.drawn[i] == 0, std::isnan(ranges.delta_R[i]));
    if (ranges.drawn[i] > 0)
      values.push_back(
          {ranges.delta_R[i], ranges.weight[i] / ranges.weight.cast<double>().sum(), ranges.drawn[i]});
  }
  EXPECT_EQ(ranges.sample_R.mean, estimate_from_draws(values, packing.contact_count()).mean);
  EXPECT_TRUE(test::same_bytes(ranges, sample_by_barrier(packing, 15, 5, 3)));
}

TEST(ContactDraw, EquallyLikelyContactsElsewhere) {
  const Packing packing = zoo::column(12, 0.3, 0.5);
  AnalyzeOptions options;
  options.contacts = {ContactChoice::Kind::kSample, 5, 1, {}};
  options.method = Method::kLp;
  const ForceRanges ranges = analyze(packing, options);
  EXPECT_EQ(ranges.draws, 0);
  EXPECT_EQ(ranges.weight.size(), 0);
  EXPECT_EQ(ranges.requested, 5);
  // A sample of all is all.
  const ForceRanges all = sample_by_barrier(packing, packing.contact_count(), 1);
  EXPECT_EQ(all.draws, 0);
  EXPECT_EQ(all.sample_R.low, all.sample_R.high);
}

}  // namespace
}  // namespace indet
