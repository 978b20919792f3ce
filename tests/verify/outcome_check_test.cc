#include "libindet/verify/outcome_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace indet {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(OutcomeCheck, ASampleHasConvergedOrReachedItsLimit) {
  SamplingRecord record;
  for (const double converged : {1.0, 0.0}) {
    record.numbers["converged"] = converged;
    for (const char* outcome : {"converged", "limit", "point", ""}) {
      const bool right = outcome == std::string(converged == 1 ? "converged" : "limit");
      const Verification found = verify_outcome(outcome, &record, nullptr);
      EXPECT_EQ(found.checks, 1);
      EXPECT_EQ(found.passed(), right) << outcome << " of " << converged;
    }
  }
  record.numbers.erase("converged");
  EXPECT_FALSE(verify_outcome("converged", &record, nullptr).passed());
}

TEST(OutcomeCheck, WithoutASampleTheRangesSayWhy) {
  ForceRanges ranges;
  for (const PolytopeStatus status :
       {PolytopeStatus::kUnbounded, PolytopeStatus::kPoint, PolytopeStatus::kEmpty}) {
    ranges.status = status;
    EXPECT_TRUE(verify_outcome(to_string(status), nullptr, &ranges).passed()) << to_string(status);
    const Verification found = verify_outcome("converged", nullptr, &ranges);
    EXPECT_THAT(found.messages, ElementsAre(HasSubstr(std::string("\"converged\" is stored, but F is ") +
                                                      to_string(status))));
  }
}

TEST(OutcomeCheck, WithNothingToCompareThereIsNoCheck) {
  EXPECT_EQ(verify_outcome("limit", nullptr, nullptr).checks, 0);
}

}  // namespace
}  // namespace indet
