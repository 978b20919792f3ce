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
  EXPECT_EQ((ranges.drawn == 0).cast<int>().matrix(), ranges.delta_R.array().isNaN().cast<int>().matrix());
  EXPECT_TRUE(test::same_bytes(ranges, sample_by_barrier(packing, 15, 5, 3)));
}

/// δ that the estimates without calibration have of all contacts, 0 where a force is determined.
Eigen::VectorXd without_calibration(const Packing& packing, bool tangential) {
  AnalyzeOptions options;
  options.estimate = EstimateOptions{.calibration = 0};
  const ForceRanges ranges = analyze(packing, options);
  const Eigen::VectorXd& estimate = (tangential ? ranges.estimated_T : ranges.estimated_R).estimate;
  return estimate.array().isNaN().select(0, estimate);
}

std::vector<DrawnValue> drawn_values(const Eigen::VectorXd& delta, const Eigen::VectorXd& prediction,
                                     const std::vector<std::int32_t>& weight,
                                     const std::vector<std::int32_t>& drawn) {
  double total = 0;
  for (const std::int32_t n : weight) total += n;
  std::vector<DrawnValue> values;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    if (drawn[i] > 0) values.push_back({delta[row], weight[i] / total, drawn[i], prediction[row]});
  }
  return values;
}

TEST(ContactDraw, MeansAreRegressedOnWhatIsEstimatedWithoutCalibration) {
  const Packing packing = zoo::column(12, 0.3, 0.5);
  const Eigen::VectorXd predicted_R = without_calibration(packing, false);
  const Eigen::VectorXd predicted_T = without_calibration(packing, true);
  for (const int draws : {5, 7, 8, 15}) {
    const ForceRanges ranges = sample_by_barrier(packing, draws, 5);
    const std::vector<std::int32_t> weight(ranges.weight.begin(), ranges.weight.end());
    const std::vector<std::int32_t> drawn(ranges.drawn.begin(), ranges.drawn.end());
    const auto expect_estimate = [&](const SampleEstimate& stored, const Eigen::VectorXd& delta,
                                     const Eigen::VectorXd& prediction) {
      const std::vector<DrawnValue> values = drawn_values(delta, prediction, weight, drawn);
      const int count = packing.contact_count();
      const SampleEstimate expected = draws < kFewestForRegression
                                          ? estimate_from_draws(values, count)
                                          : estimate_by_regression(values, count, prediction.mean());
      EXPECT_NEAR(stored.mean, expected.mean, 1e-12 * expected.mean);
      EXPECT_EQ(std::isnan(stored.low), draws < kFewestForInterval);
      if (draws < kFewestForInterval) return;
      EXPECT_NEAR(stored.low, expected.low, 1e-12 * expected.mean);
      EXPECT_NEAR(stored.high, expected.high, 1e-12 * expected.mean);
    };
    expect_estimate(ranges.sample_R, ranges.delta_R, predicted_R);
    expect_estimate(ranges.sample_T, ranges.delta_T, predicted_T);
    EXPECT_EQ(ranges.estimator,
              draws < kFewestForRegression ? DrawEstimator::kMean : DrawEstimator::kRegression);
  }
}

/// Repeated draws from packings all of whose δ are known. They are unlike those that the predictions were
/// fitted to: these help with R, and are of no use with T.
TEST(ContactDraw, RegressionIsUnbiasedCoversAndIsBetterWhereItIsWellPredicted) {
  constexpr int kRepeats = 2000;
  constexpr int kDraws = 20;
  int tried = 0;
  for (std::uint64_t seed = 1; tried < 2; ++seed) {
    ASSERT_LT(seed, 20);
    const Packing pile = zoo::random_pile(seed, 40, 0.3);
    const ForceRanges sample = sample_by_barrier(pile, 1, 1);
    if (sample.draws == 0) continue;  // unbounded, or empty
    ++tried;
    AnalyzeOptions options;
    options.method = Method::kBarrier;
    const ForceRanges all = analyze(pile, options);
    const std::vector<std::int32_t> weight(sample.weight.begin(), sample.weight.end());
    for (const bool tangential : {false, true}) {
      const Eigen::VectorXd& delta = tangential ? all.delta_T : all.delta_R;
      const Eigen::VectorXd prediction = without_calibration(pile, tangential);
      const double mean = delta.mean();
      double sum = 0;
      double squares = 0;
      double squares_of_draws = 0;
      int covered = 0;
      for (std::uint64_t repeat = 0; repeat < kRepeats; ++repeat) {
        const std::vector<DrawnValue> values =
            drawn_values(delta, prediction, weight, draw_with_replacement(weight, kDraws, repeat));
        const SampleEstimate estimate =
            estimate_by_regression(values, pile.contact_count(), prediction.mean());
        const SampleEstimate of_draws = estimate_from_draws(values, pile.contact_count());
        sum += estimate.mean - mean;
        squares += (estimate.mean - mean) * (estimate.mean - mean);
        squares_of_draws += (of_draws.mean - mean) * (of_draws.mean - mean);
        covered += estimate.low <= mean && mean <= estimate.high ? 1 : 0;
      }
      // The bias of a regression is small beside its error at 20 draws.
      const double error = std::sqrt(squares / kRepeats);
      EXPECT_LT(std::abs(sum / kRepeats), 0.25 * error) << seed << tangential;
      EXPECT_GT(covered, 0.87 * kRepeats) << seed << tangential;
      EXPECT_LT(covered, 0.985 * kRepeats) << seed << tangential;
      EXPECT_LT(squares, (tangential ? 1.1 : 0.75) * squares_of_draws) << seed << tangential;
    }
  }
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
