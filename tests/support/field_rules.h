#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "libindet/range/force_ranges.h"

namespace indet::test {

/// What must hold of a field of the results of one packing when it is seen otherwise: with its disks and
/// contacts in another order, mirrored, turned, in other units. The results that are expected are mapped
/// first (compare.h).
enum class FieldRule : std::uint8_t {
  kEqual,        ///< the same
  kNear,         ///< the same but for the tolerance, and for what rounding of the normals does to the values
  kInterval,     ///< contains the same value: with the other end, it overlaps the expected interval
  kSensitivity,  ///< the same but for 1e-6 of it
  kPlace,        ///< as kNear, of a force within its range, so relative to the width of that
  kByState,      ///< as kNear, of the state that the value is attained by (numbers of states may differ)
  kSameSize,     ///< as many entries, which are one of several that would do
  kNot           ///< need not be the same
};

struct RuleOfField {
  const char* field;  ///< group/name of tables, group@name of others
  FieldRule rule;
  const char* reason = "";  ///< why it need not be the same
};
/// One for each field of the results.
const std::vector<RuleOfField>& field_rules();

/// The names of all fields of the results, those that have something to say, and those with a rule.
std::set<std::string> all_fields();
std::set<std::string> told_fields(const ForceRanges& ranges);
std::set<std::string> ruled_fields();

/// How near results must be.
struct Nearness {
  double tolerance = 1e-9;  ///< of kNear and kByState, relative to max(1 mg, |value|)
  double turn = 0;          ///< the largest angle by which rounding turned a normal
  bool rounds = false;      ///< numbers of the scene were rounded: states may differ by 1e3 tolerances
  std::set<std::string> except = {};  ///< fields that this view does not keep, which its maker explains
};

/// Whether every field is as its rule says. Forces of both in the same unit; kInterval without any tolerance
/// but sensitivity · turn, where a bound of that is known, and one rounding where numbers are rounded.
testing::AssertionResult keeps_rules(const ForceRanges& expected, const ForceRanges& found,
                                     const Nearness& nearness);

}  // namespace indet::test
