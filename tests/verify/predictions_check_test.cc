#include "libindet/verify/predictions_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <utility>

#include "libindet/range/analyze.h"
#include "libindet/verify/verify.h"
#include "tests/support/zoo.h"
#include "tests/verify/first_message.h"

namespace indet {
namespace {

using testing::HasSubstr;

ForceRanges estimate(const Packing& packing, int calibration) {
  AnalyzeOptions options;
  options.gap = 1e-2;
  options.estimate = EstimateOptions{calibration, 5};
  return analyze(packing, options);
}

class PredictionsCheck : public testing::Test {
 protected:
  Verification check(const ForceRanges& ranges) const {
    Comparisons compare;
    check_predictions(packing_, ranges, RebuiltProblem(packing_), compare);
    return compare.result();
  }

  template <class Change>
  void expect_contradiction(Change change, const std::string& text) const {
    ForceRanges wrong = good_;
    change(wrong);
    EXPECT_THAT(first_message(check(wrong)), HasSubstr(text));
  }

  Packing packing_ = zoo::column(20, 0.3, 0.5);
  ForceRanges good_ = estimate(packing_, 20);
};

TEST_F(PredictionsCheck, FindNothingWrongWithAnAnalysis) {
  for (const int calibration : {0, 1, 5, 20, 41, 1000}) {
    SCOPED_TRACE(calibration);
    const Verification found = verify_ranges(packing_, estimate(packing_, calibration));
    EXPECT_TRUE(found.passed()) << first_message(found);
  }
  for (const Packing& packing : {zoo::wedge_and_corner(0.4, 0.3), zoo::frictionless_column(5, 0.4)}) {
    const Verification found = verify_ranges(packing, estimate(packing, 0));
    EXPECT_TRUE(found.passed()) << first_message(found);
  }
}

TEST_F(PredictionsCheck, TellWhatDoesNotFollow) {
  int calibrates = 0;
  while (good_.calibrates[calibrates] == 0) ++calibrates;
  int predicted = 0;
  while (good_.calibrates[predicted] == 1) ++predicted;
  expect_contradiction([](ForceRanges& r) { r.width(3, 1) *= 1.001; }, "width of T of contact 3");
  expect_contradiction([](ForceRanges& r) { r.coverage = 0.9; }, "coverage");
  expect_contradiction([](ForceRanges& r) { ++r.sample_seed; }, "calibrates of contact");
  expect_contradiction([](ForceRanges& r) { ++r.calibration; }, "requested");
  expect_contradiction([&](ForceRanges& r) { std::swap(r.calibrates[calibrates], r.calibrates[predicted]); },
                       "calibrates of contact");
  expect_contradiction([&](ForceRanges& r) { r.outcome(predicted, 1) = Outcome::kEnclosed; },
                       "R_max: enclosed");
  expect_contradiction([&](ForceRanges& r) { r.delta_R[calibrates] *= 1.01; }, "delta_R_");
  expect_contradiction([&](ForceRanges& r) { r.estimated_R.estimate[predicted] *= 1 + 1e-9; },
                       "delta_R_estimate of contact");
  expect_contradiction([&](ForceRanges& r) { r.estimated_T.low[predicted] *= 1 - 1e-9; },
                       "delta_T_low of contact");
  expect_contradiction([&](ForceRanges& r) { r.estimated_T.high[predicted] *= 1 + 1e-9; },
                       "delta_T_high of contact");
  expect_contradiction([&](ForceRanges& r) { r.estimated_R.high[calibrates] = 1; },
                       "delta_R_high of contact");
}

}  // namespace
}  // namespace indet
