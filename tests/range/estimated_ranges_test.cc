#include "libindet/range/estimated_ranges.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <vector>

#include "libindet/base/error.h"
#include "libindet/range/analyze.h"
#include "libindet/range/estimate_coefficients.h"
#include "tests/support/zoo.h"

namespace indet {
namespace {

ForceRanges estimate(const Packing& packing, int calibration, std::uint64_t seed = 1, int threads = 1) {
  AnalyzeOptions options;
  options.gap = 1e-3;
  options.estimate = EstimateOptions{calibration, seed};
  options.threads = threads;
  return analyze(packing, options);
}

ForceRanges all_ranges(const Packing& packing) {
  AnalyzeOptions options;
  options.states.kind = StateChoice::Kind::kNone;
  return analyze(packing, options);
}

/// A pile whose forces are limited, of some 60 contacts.
const Packing& pile() {
  static const Packing packing = [] {
    for (std::uint64_t seed = 0;; ++seed) {
      Packing pile = zoo::random_pile(seed, 30, 0.4);
      const ForceRanges ranges = all_ranges(pile);
      if (ranges.status == PolytopeStatus::kBounded && ranges.dim > 8) return pile;
    }
  }();
  return packing;
}

struct Share {
  int held = 0, all = 0;
  double value() const { return held / static_cast<double>(all); }
};

void count(const DeltaEstimates& estimates, const Eigen::VectorXd& delta, Share& share) {
  for (Eigen::Index i = 0; i < delta.size(); ++i) {
    if (std::isnan(estimates.estimate[i])) continue;
    ++share.all;
    share.held += estimates.low[i] <= delta[i] && delta[i] <= estimates.high[i] ? 1 : 0;
  }
}

TEST(EstimateModel, IsTheFormulaOfItsHeader) {
  EstimateModel model{};
  model.least = {-9, -9, -9, 0};
  model.largest = {9, 9, 9, 1};
  model.location = {0.5, 0.25, 1, 2, 3, 4, 0.1, 0.2, 0.3, 0.4};
  model.scale = {-1, 0.5, 0.25, 0.125};
  const ContactSituation contact{2, 4, 8, 1.2, 2, 0.5, 0.3, 700};
  const double D = std::log(std::log(700.0)), c1 = std::log(0.5), c3 = std::log(0.25 / 0.3), c4 = 0.5;
  for (const bool tangential : {false, true}) {
    const double c2 = std::log(tangential ? 2 / 2.4 : 0.25);
    const LogPrediction log = predict(model, tangential, contact);
    EXPECT_NEAR(log.location,
                0.5 + 0.25 * D + c1 + 2 * c2 + 3 * c3 + 4 * c4 + 0.1 * c1 * c1 + 0.2 * c2 * c2 +
                    0.3 * c1 * D + 0.4 * c2 * D,
                1e-14);
    EXPECT_NEAR(log.scale, std::exp(-1 + 0.5 * D + 0.25 * c1 + 0.125 * c2), 1e-14);
  }
}

ContactSituation contact_of_dimension(int dimension) { return {2, 4, 8, 1.2, 2, 0.5, 0.3, dimension}; }

TEST(EstimateModel, TakesTheEndOfARangeForWhatLiesOutside) {
  const ContactSituation frictionless{2, 4, 8, 0, 2, 0, 0, 7};
  const LogPrediction log = predict(kModelOfR, false, frictionless);
  EXPECT_TRUE(std::isfinite(log.location));
  EXPECT_EQ(predict(kModelOfR, false, contact_of_dimension(1)).location,
            predict(kModelOfR, false, contact_of_dimension(8)).location);
  const ContactSituation tiny{1e-30, 1, 1, 0, 1e-30, 1e-30, 0.3, 7};
  const ContactSituation tinier{1e-40, 1, 1, 0, 1e-40, 1e-40, 0.3, 7};
  EXPECT_EQ(predict(kModelOfR, false, tiny).location, predict(kModelOfR, false, tinier).location);
}

TEST(EstimatedRanges, KnowWhatTheyWereCalibratedOnAndPredictTheRest) {
  const ForceRanges all = all_ranges(pile());
  const ForceRanges ranges = estimate(pile(), 20);
  EXPECT_EQ(ranges.choice, ContactChoice::Kind::kCalibration);
  EXPECT_EQ(ranges.requested, 20);
  EXPECT_EQ(ranges.calibrates.cast<int>().sum(), 20);
  EXPECT_EQ(ranges.sample_seed, 1);
  EXPECT_EQ(ranges.coverage, 0.95);
  EXPECT_EQ(ranges.certified, ranges.objectives);
  for (Eigen::Index i = 0; i < all.delta_R.size(); ++i) {
    for (int column = 0; column < 4; ++column) {
      const bool is_estimate = ranges.outcome(i, column) == Outcome::kEstimate;
      EXPECT_EQ(std::isnan(ranges.value(i, column)), is_estimate);
      EXPECT_FALSE(is_estimate && ranges.calibrates[i] == 1);
      if (is_estimate) continue;
      EXPECT_LE(ranges.lower(i, column), all.upper(i, column));
      EXPECT_GE(ranges.upper(i, column), all.lower(i, column));
    }
    for (const auto& [estimates, delta, known, k] :
         {std::tuple(&ranges.estimated_R, ranges.delta_R[i], all.delta_R[i], 0),
          {&ranges.estimated_T, ranges.delta_T[i], all.delta_T[i], 1}}) {
      EXPECT_NE(std::isnan(delta), std::isnan(estimates->estimate[i]));
      if (!std::isnan(delta)) continue;
      EXPECT_LE(estimates->low[i], estimates->estimate[i]);
      EXPECT_LE(estimates->estimate[i], estimates->high[i]);
      EXPECT_GE(estimates->low[i], 2 * ranges.width(i, k) / ranges.force_unit);
      EXPECT_GT(known, 1e-9) << "determined forces have no estimate";
    }
  }
}

TEST(EstimatedRanges, HoldInTheMeanOverDrawsWhateverThePacking) {
  // A pile by chance is nothing like the packings of the fit.
  const ForceRanges all = all_ranges(pile());
  Share R, T;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const ForceRanges ranges = estimate(pile(), 20, seed);
    count(ranges.estimated_R, all.delta_R, R);
    count(ranges.estimated_T, all.delta_T, T);
  }
  // 20/21, and a standard deviation of 0.05 a draw.
  EXPECT_NEAR(R.value(), 20.0 / 21, 4 * 0.05 / std::sqrt(60.0));
  EXPECT_NEAR(T.value(), 20.0 / 21, 4 * 0.05 / std::sqrt(60.0));
}

TEST(EstimatedRanges, NeedNoRangesAtAll) {
  const ForceRanges ranges = estimate(pile(), 0);
  EXPECT_EQ(ranges.requested, 0);
  EXPECT_EQ(ranges.sample_seed, -1);
  EXPECT_EQ(ranges.solves, 0);
  EXPECT_EQ(ranges.calibrates.cast<int>().sum(), 0);
  // The middle of the band is the location of the model.
  const Eigen::Index i = 3;
  ASSERT_EQ(ranges.outcome(i, kMinR), Outcome::kEstimate);
  double mean = 0;
  int varying = 0;
  for (Eigen::Index k = 0; k < ranges.width.rows(); ++k) {
    if (ranges.outcome(k, kMinR) != Outcome::kEstimate) continue;
    mean += ranges.width(k, 0);
    ++varying;
  }
  const ContactSituation contact{ranges.width(i, 0),      mean / varying,     ranges.centre(i, 0),
                                 ranges.centre(i, 1),     ranges.width(i, 0), ranges.width(i, 1),
                                 pile()[ContactId(3)].mu, ranges.dim};
  EXPECT_NEAR(ranges.estimated_R.estimate[i] * ranges.force_unit / ranges.width(i, 0),
              std::max(2.0, std::exp(predict(kModelOfR, false, contact).location)), 1e-9);
}

TEST(EstimatedRanges, OfAllContactsAreNone) {
  const ForceRanges ranges = estimate(zoo::wedge(0.4, 0.3), 20);
  EXPECT_EQ(ranges.requested, 2);
  EXPECT_EQ(ranges.enclosed, 8);
  EXPECT_NEAR(ranges.delta_R[0], zoo::wedge_ranges(0.4, 0.3).delta_R, 2e-3);
  EXPECT_TRUE(ranges.estimated_R.estimate.array().isNaN().all());
}

TEST(EstimatedRanges, ProveWhatIsDetermined) {
  // Friction at the wall is too weak for any force there; the floor carries the disk's weight alone.
  const Packing packing = zoo::wedge_and_corner(0.4, 0.3);
  const ForceRanges all = all_ranges(packing);
  const ForceRanges ranges = estimate(packing, 0);
  int determined = 0;
  for (Eigen::Index i = 0; i < all.delta_R.size(); ++i) {
    if (all.delta_R[i] > 1e-9) {
      EXPECT_EQ(ranges.outcome(i, kMinR), Outcome::kEstimate);
      continue;
    }
    ++determined;
    EXPECT_EQ(ranges.delta_R[i], 0);
    EXPECT_EQ(ranges.outcome(i, kMaxR), Outcome::kEnclosed);
    EXPECT_LE(ranges.lower(i, kMinR), all.value(i, kMinR));
    EXPECT_GE(ranges.upper(i, kMinR), all.value(i, kMinR));
    EXPECT_LE(ranges.upper(i, kMinR) - ranges.lower(i, kMinR), 1e-6);
  }
  EXPECT_EQ(determined, 2);
  EXPECT_EQ(ranges.determined, 8);
  EXPECT_EQ(ranges.failed, 0);
}

TEST(EstimatedRanges, OfAPointAreAllProven) {
  for (const Packing& packing : {zoo::disk_on_floor(0.3), zoo::frictionless_column(6, 0.4)}) {
    const ForceRanges all = all_ranges(packing);
    const ForceRanges ranges = estimate(packing, 20);
    EXPECT_EQ(ranges.status, PolytopeStatus::kPoint);
    EXPECT_EQ(ranges.requested, 0);
    EXPECT_EQ(ranges.enclosed, 4 * packing.contact_count());
    EXPECT_EQ(ranges.determined, ranges.enclosed);
    EXPECT_LT((ranges.value - all.value).abs().maxCoeff(), 1e-6);
  }
}

TEST(EstimatedRanges, NeedACentre) {
  EXPECT_THROW(estimate(zoo::wedge(1.4, 0.3), 0), InputError);
  const ForceRanges empty = estimate(zoo::disk_on_incline(0.1, 1), 20);
  EXPECT_EQ(empty.status, PolytopeStatus::kEmpty);
  EXPECT_EQ(empty.calibration, -1);
}

TEST(EstimatedRanges, DoNotDependOnThreadsAndScaleWithUnits) {
  const ForceRanges one = estimate(pile(), 20);
  const ForceRanges three = estimate(pile(), 20, 1, 3);
  const ForceRanges other = estimate(zoo::rescaled(pile(), 4, 0.5, 8), 20);
  for (Eigen::Index i = 0; i < one.width.rows(); ++i) {
    if (std::isnan(one.estimated_R.estimate[i])) continue;
    EXPECT_EQ(one.estimated_R.low[i], three.estimated_R.low[i]);
    EXPECT_EQ(one.estimated_R.estimate[i], other.estimated_R.estimate[i]);
  }
}

TEST(EstimatedRanges, StopWhenAsked) {
  AnalyzeOptions options;
  options.estimate = EstimateOptions{20, 1};
  options.progress = [](const Progress& progress) { return progress.done == 0; };
  EXPECT_THROW(analyze(pile(), options), Interrupted);
}

}  // namespace
}  // namespace indet
