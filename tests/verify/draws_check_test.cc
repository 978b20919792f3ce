#include "libindet/verify/draws_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "libindet/range/analyze.h"
#include "tests/support/zoo.h"
#include "tests/verify/first_message.h"

namespace indet {
namespace {

using testing::HasSubstr;

class DrawsCheck : public testing::Test {
 protected:
  static ForceRanges sample(const Packing& packing) {
    AnalyzeOptions options;
    options.method = Method::kBarrier;
    options.contacts = {ContactChoice::Kind::kSample, 15, 5, {}};
    return analyze(packing, options);
  }

  Verification check(const ForceRanges& ranges) const {
    Comparisons compare;
    check_draws(packing_, ranges, RebuiltProblem(packing_), compare);
    return compare.result();
  }

  template <class Change>
  void expect_contradiction(Change change, const std::string& text) const {
    ForceRanges wrong = good_;
    change(wrong);
    EXPECT_THAT(first_message(check(wrong)), HasSubstr(text));
  }

  Packing packing_ = zoo::column(12, 0.3, 0.5);
  ForceRanges good_ = sample(packing_);
};

TEST_F(DrawsCheck, FindsNothingWrongWithAnAnalysis) {
  ASSERT_EQ(good_.draws, 15);
  const Verification found = check(good_);
  EXPECT_TRUE(found.passed()) << first_message(found);
  EXPECT_GT(found.checks, 4 * packing_.contact_count());
  EXPECT_TRUE(found.unchecked.empty());
}

TEST_F(DrawsCheck, TellsWhatDoesNotFollow) {
  expect_contradiction([](ForceRanges& r) { r.centre(3, 0) *= 1.001; }, "centre: its forces do not balance");
  expect_contradiction([](ForceRanges& r) { r.width(3, 1) *= 1.001; }, "width of T of contact 3");
  expect_contradiction([](ForceRanges& r) { ++r.weight[2]; }, "draw_weight");
  expect_contradiction([](ForceRanges& r) { std::swap(r.drawn[0], r.drawn[1]), ++r.drawn[0]; },
                       "drawn of contact");
  expect_contradiction([](ForceRanges& r) { ++r.sample_seed; }, "drawn of contact");
  expect_contradiction([](ForceRanges& r) { r.sample_R.mean *= 1 + 1e-9; }, "mean_delta_R");
  expect_contradiction([](ForceRanges& r) { r.sample_R.low -= 1e-9; }, "lower end of mean_delta_R");
  expect_contradiction([](ForceRanges& r) { r.sample_T.high += 1e-9; }, "upper end of mean_delta_T");
  expect_contradiction([](ForceRanges& r) { r.sample_T.band *= 1.1; }, "band_delta_T");
  expect_contradiction([](ForceRanges& r) { r.estimator = DrawEstimator::kMean; }, "mean_delta_R");
}

/// As files were written before means were found by regression.
TEST_F(DrawsCheck, KnowsTheMeanOfDraws) {
  ForceRanges older = good_;
  older.estimator = DrawEstimator::kMean;
  const auto estimate = [&](const Eigen::VectorXd& delta) {
    std::vector<DrawnValue> values;
    for (Eigen::Index i = 0; i < delta.size(); ++i) {
      if (older.drawn[i] > 0)
        values.push_back({delta[i], older.weight[i] / older.weight.cast<double>().sum(), older.drawn[i]});
    }
    return estimate_from_draws(values, packing_.contact_count());
  };
  older.sample_R = estimate(older.delta_R);
  older.sample_T = estimate(older.delta_T);
  const Verification found = check(older);
  EXPECT_TRUE(found.passed()) << first_message(found);
  older.estimator = DrawEstimator::kRegression;
  EXPECT_THAT(first_message(check(older)), HasSubstr("mean_delta_R"));
}

/// A state within F that is not its centre.
TEST_F(DrawsCheck, TellsAnotherStateFromTheCentre) {
  AnalyzeOptions options;
  options.method = Method::kLp;
  const ForceRanges all = analyze(packing_, options);
  ForceRanges wrong = good_;
  const Eigen::VectorXd state = all.states.row(0).transpose();
  for (Eigen::Index i = 0; i < wrong.centre.rows(); ++i)
    wrong.centre.row(i) = 0.99 * wrong.centre.row(i) + 0.01 * state.segment<2>(2 * i).transpose();
  EXPECT_THAT(first_message(check(wrong)), HasSubstr("centre: the analytic centre is elsewhere"));
}

TEST_F(DrawsCheck, FindsNothingWrongInPiles) {
  int drawn = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Packing pile = zoo::random_pile(seed, 40, 0.3);
    AnalyzeOptions options;
    options.method = Method::kBarrier;
    options.gap = 1e-2;
    options.contacts = {ContactChoice::Kind::kSample, 6, seed, {}};
    const ForceRanges ranges = analyze(pile, options);
    if (ranges.draws == 0) continue;  // unbounded, or empty
    ++drawn;
    Comparisons compare;
    check_draws(pile, ranges, RebuiltProblem(pile), compare);
    EXPECT_TRUE(compare.result().passed()) << seed << ": " << first_message(compare.result());
  }
  EXPECT_GT(drawn, 2);
}

}  // namespace
}  // namespace indet
