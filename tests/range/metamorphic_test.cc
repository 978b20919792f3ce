#include "tests/range/metamorphic.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <type_traits>

#include "libindet/range/analyze.h"
#include "libindet/range/result_fields.h"
#include "tests/support/zoo.h"

namespace indet {
namespace {

TEST(Metamorphic, EveryFieldHasARule) { EXPECT_EQ(test::ruled_fields(), test::all_fields()); }

/// Adds 1 to the first entry of one field.
ForceRanges with_a_change(const ForceRanges& ranges, const std::string& name) {
  ForceRanges result = ranges;
  visit_fields(result, [&]<class Value>(const Field& field, Value&& value) {
    if (std::string(field.group) + (field.is_dataset() ? "/" : "@") + field.name != name) return;
    if constexpr (requires { value.rows(); }) {
      using Number = typename std::decay_t<Value>::Scalar;
      if (value.size() > 0) value(0, 0) = static_cast<Number>(static_cast<double>(value(0, 0)) + 1);
    } else if constexpr (std::is_arithmetic_v<std::decay_t<Value>>) {
      value = static_cast<std::decay_t<Value>>(value + 1);
    }
  });
  return result;
}

TEST(Metamorphic, AChangedFieldBreaksItsRule) {
  const ForceRanges ranges = analyze(zoo::wedge(0.4, 0.3));
  EXPECT_TRUE(test::keeps_rules(ranges, ranges, {}));
  for (const char* name :
       {"/equilibrium@rank", "/equilibrium@doubtful", "/equilibrium@force_unit", "/ranges/R_min",
        "/ranges/T_max", "/ranges/lower", "/ranges/sensitivity", "/ranges/sensitivity_claim",
        "/ranges/outcome", "/ranges/unique", "/ranges/delta_R", "/ranges/d_T", "/extremal/norm",
        "/extremal/states", "/reactions/value", "/reactions/lower", "/reactions/body",
        "/equilibrium@determined"})
    EXPECT_FALSE(test::keeps_rules(ranges, with_a_change(ranges, name), {})) << name;
}

TEST(Metamorphic, FieldsOfAFewPackingsKeepToTheirRules) {
  std::set<std::string> told;
  EXPECT_GT(test::compare_views(14, 16, told).made, 100);
  for (const char* field :
       {"/ranges/lower", "/ranges/sensitivity_claim", "/ranges/d_R_min", "/extremal/states", "/duals/points",
        "/reactions/value", "/ranges/delta_R_estimate"})
    EXPECT_THAT(told, testing::Contains(field));
}

}  // namespace
}  // namespace indet
