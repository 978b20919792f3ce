#include <gtest/gtest.h>

#include "tests/range/metamorphic.h"

namespace indet {
namespace {

TEST(MetamorphicLong, FieldsOfFiftyPackingsKeepToTheirRules) {
  std::set<std::string> told;
  const test::Comparisons comparisons = test::compare_views(1, 50, told);
  EXPECT_GT(comparisons.made, 1300);
  EXPECT_LE(comparisons.by_another_method, 2) << "of scene 20, whose centre is found in some units alone";
}

}  // namespace
}  // namespace indet
