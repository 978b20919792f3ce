#include "tests/support/field_rules.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string_view>
#include <tuple>
#include <type_traits>

#include "libindet/base/constants.h"
#include "libindet/base/tolerances.h"
#include "libindet/range/result_fields.h"
#include "tests/support/compare.h"

namespace indet::test {
namespace {

using testing::AssertionFailure;
using testing::AssertionResult;
using testing::AssertionSuccess;

constexpr const char* kWorkReason = "tells how the result was found";
constexpr const char* kRoundingReason = "is what rounding left";
constexpr const char* kProofReason = "is one of several proofs";
constexpr const char* kDrawReason = "seeds draw contacts by their numbers";

std::string path_of(const Field& field) {
  return std::string(field.group) + (field.is_dataset() ? "/" : "@") + field.name;
}

/// A field as numbers or as text.
struct Entry {
  Eigen::MatrixXd numbers;
  std::string text;
  bool is_in_force = false;  ///< in the scene's unit of force
  bool of_contacts = false;
};

std::map<std::string, Entry> entries_of(const ForceRanges& ranges) {
  std::map<std::string, Entry> all;
  visit_fields(ranges, [&]<class Value>(const Field& field, const Value& value) {
    Entry entry;
    entry.is_in_force = std::string_view(field.unit).starts_with("force");
    entry.of_contacts = field.rows == Extent::kContacts;
    if constexpr (requires { value.rows(); })
      entry.numbers = value.template cast<double>().matrix();
    else if constexpr (requires { value.data(); })
      entry.text = value;
    else if constexpr (requires { std::get<2>(value); })
      entry.numbers = Eigen::Vector3d(std::get<0>(value), std::get<1>(value), std::get<2>(value));
    else
      entry.numbers = Eigen::MatrixXd::Constant(1, 1, static_cast<double>(value));
    all.emplace(path_of(field), std::move(entry));
  });
  return all;
}

bool has_bound(const Sensitivities& sensitivity, Eigen::Index i, int column) {
  return sensitivity.claim(i, column) != static_cast<std::uint8_t>(SensitivityClaim::kNone);
}

/// By how much rounding may have moved a value: without limit where no bound of that is known.
double widening(const ForceRanges& ranges, Eigen::Index i, int column, double turn) {
  if (turn == 0 || std::isinf(ranges.value(i, column))) return 0;
  const double sensitivity = ranges.sensitivity.value(i, column);
  return has_bound(ranges.sensitivity, i, column) ? sensitivity * turn : kInfinity;
}

/// In which way entries of a table of contacts may have moved: by the worst of the contact's values.
double widening(const ForceRanges& ranges, Eigen::Index i, double turn) {
  double worst = 0;
  for (int column = 0; column < 4; ++column) {
    if (std::isfinite(ranges.value(i, column))) worst = std::max(worst, widening(ranges, i, column, turn));
  }
  return worst;
}

AssertionResult is_near(const Entry& a, const Entry& b, const ForceRanges& ranges, double tolerance,
                        double turn) {
  if (a.numbers.rows() != b.numbers.rows() || a.numbers.cols() != b.numbers.cols() || a.text != b.text)
    return AssertionFailure() << "has another size or text";
  const double unit = a.is_in_force ? ranges.force_unit : 1;
  for (Eigen::Index i = 0; i < a.numbers.rows(); ++i) {
    const double wide = a.of_contacts ? 2 * widening(ranges, i, turn) / ranges.force_unit : 0;
    if (std::isinf(wide)) continue;
    for (Eigen::Index j = 0; j < a.numbers.cols(); ++j) {
      const double x = a.numbers(i, j) / unit;
      const double y = b.numbers(i, j) / unit;
      if (std::abs(x - y) <= wide || near(x, y, tolerance)) continue;
      return AssertionFailure() << "at (" << i << ", " << j << ") is " << testing::PrintToString(y)
                                << ", not " << testing::PrintToString(x);
    }
  }
  return AssertionSuccess();
}

bool overlap(double low, double high, double other_low, double other_high, double wide) {
  if (std::isnan(low) || std::isnan(other_low)) return std::isnan(low) == std::isnan(other_low);
  return std::max(low, other_low) <= std::min(high, other_high) + wide;
}

/// All fields of rule kInterval.
AssertionResult intervals_overlap(const ForceRanges& a, const ForceRanges& b, const Nearness& nearness) {
  // A conversion rounds each end.
  const auto rounding = [&](double x, double y) {
    const double size = std::max(std::abs(x), std::abs(y));
    return nearness.rounds && std::isfinite(size) ? 4 * std::numeric_limits<double>::epsilon() * size : 0;
  };
  for (Eigen::Index i = 0; i < a.lower.rows(); ++i) {
    for (int j = 0; j < 4; ++j) {
      const double wide = widening(a, i, j, nearness.turn) + rounding(a.lower(i, j), a.upper(i, j));
      if (!overlap(a.lower(i, j), a.upper(i, j), b.lower(i, j), b.upper(i, j), wide))
        return AssertionFailure() << "/ranges/lower, upper of contact " << i << ", " << j << ": ["
                                  << a.lower(i, j) << ", " << a.upper(i, j) << "] against [" << b.lower(i, j)
                                  << ", " << b.upper(i, j) << "]";
    }
  }
  const Reactions& r = a.reactions;
  for (Eigen::Index k = 0; k < r.lower.size() && nearness.turn == 0; ++k) {
    const double low = r.lower.data()[k];
    const double high = r.upper.data()[k];
    if (!overlap(low, high, b.reactions.lower.data()[k], b.reactions.upper.data()[k], rounding(low, high)))
      return AssertionFailure() << "/reactions/lower, upper of " << k / 2 << ": [" << low << ", " << high
                                << "] against [" << b.reactions.lower.data()[k] << ", "
                                << b.reactions.upper.data()[k] << "]";
  }
  for (Eigen::Index i = 0; i < a.smallest.lower.rows() && nearness.turn == 0; ++i) {
    for (const int c : {0, 1}) {
      // Distances are those of states that are a little off the extremes.
      if (std::isnan(a.smallest.of(c)[i]) || std::isnan(b.smallest.of(c)[i])) continue;  // not known
      const double wide = tolerance::kDistanceGap * std::max(1.0, a.smallest.of(c)[i]);
      if (!overlap(a.smallest.lower(i, c), a.smallest.of(c)[i], b.smallest.lower(i, c), b.smallest.of(c)[i],
                   wide))
        return AssertionFailure() << "d_min of contact " << i << ", " << c << ": [" << a.smallest.lower(i, c)
                                  << ", " << a.smallest.of(c)[i] << "] against [" << b.smallest.lower(i, c)
                                  << ", " << b.smallest.of(c)[i] << "]";
    }
  }
  return AssertionSuccess();
}

/// Of those that claim something.
AssertionResult same_sensitivities(const Entry& a, const Entry& b, const ForceRanges& ranges) {
  constexpr double kSame = 1e-6;
  Entry x = a;
  Entry y = b;
  for (Eigen::Index i = 0; i < a.numbers.rows(); ++i) {
    for (int j = 0; j < 4; ++j) {
      if (!has_bound(ranges.sensitivity, i, j)) x.numbers(i, j) = y.numbers(i, j) = 0;
    }
  }
  return is_near(x, y, ranges, kSame, 0);
}

/// (R − R_min)/δR, or that of T: both ends are known to so much.
AssertionResult same_places(const Entry& a, const Entry& b, const ForceRanges& ranges, bool tangential,
                            const Nearness& nearness) {
  for (Eigen::Index i = 0; i < a.numbers.rows(); ++i) {
    const double x = a.numbers(i, 0);
    const double y = b.numbers(i, 0);
    const double least = ranges.value(i, tangential ? kMinT : kMinR);
    const double most = ranges.value(i, tangential ? kMaxT : kMaxR);
    const double size = std::max({ranges.force_unit, std::abs(least), std::abs(most)});
    const double off = nearness.tolerance * size + 2 * widening(ranges, i, nearness.turn);
    if (near(x, y, std::max(nearness.tolerance, 2 * off / (most - least)))) continue;
    return AssertionFailure() << "of contact " << i << " is " << y << ", not " << x;
  }
  return AssertionSuccess();
}

AssertionResult keeps_rule(const RuleOfField& rule, const Entry& a, const Entry& b, const ForceRanges& ranges,
                           const Nearness& nearness) {
  switch (rule.rule) {
    case FieldRule::kEqual:
      return is_near(a, b, ranges, 0, 0);
    case FieldRule::kNear:
      return is_near(a, b, ranges, nearness.tolerance, nearness.turn);
    case FieldRule::kSensitivity:
      return same_sensitivities(a, b, ranges);
    case FieldRule::kPlace:
      return same_places(a, b, ranges, std::string_view(rule.field) == "/ranges/T_star", nearness);
    case FieldRule::kSameSize:
      if (a.numbers.rows() == b.numbers.rows() && a.numbers.cols() == b.numbers.cols())
        return AssertionSuccess();
      return AssertionFailure() << "has " << b.numbers.size() << " entries, not " << a.numbers.size();
    case FieldRule::kInterval:
    case FieldRule::kByState:
    case FieldRule::kNot:
      break;
  }
  return AssertionSuccess();
}

}  // namespace

const std::vector<RuleOfField>& field_rules() {
  using enum FieldRule;
  static const std::vector<RuleOfField> rules = {
      {"/ranges@contacts", kEqual},
      {"/ranges@requested", kEqual},
      {"/ranges@draws", kEqual},
      {"/ranges@sample_seed", kEqual},
      {"/ranges/draw_weight", kNot, kDrawReason},
      {"/ranges/drawn", kNot, kDrawReason},
      {"/ranges/centre", kNear},
      {"/ranges/width", kNear},
      {"/equilibrium@status", kEqual},
      {"/equilibrium@unknowns", kEqual},
      {"/equilibrium@equations", kEqual},
      {"/equilibrium@rank", kEqual},
      {"/equilibrium@nullity", kEqual},
      {"/equilibrium@dim", kEqual},
      {"/equilibrium@blocks", kEqual},
      {"/equilibrium@blocks_reason", kNot, kRoundingReason},
      {"/equilibrium@rank_ambiguous", kEqual},
      {"/equilibrium@exact", kNot, kRoundingReason},
      {"/equilibrium@hairline", kNot, kRoundingReason},
      {"/equilibrium@rank_gap", kNot, kRoundingReason},
      {"/equilibrium@smallest_accepted", kNot, kRoundingReason},
      {"/equilibrium@largest_rejected", kNot, kRoundingReason},
      {"/equilibrium@force_unit", kNear},
      {"/equilibrium/motion", kSameSize},
      {"/equilibrium/wall_motion", kSameSize},
      {"/equilibrium/cell_motion", kSameSize},
      {"/equilibrium/bound_multipliers", kSameSize},
      {"/ranges/R_min", kNear},
      {"/ranges/R_max", kNear},
      {"/ranges/T_min", kNear},
      {"/ranges/T_max", kNear},
      {"/ranges/lower", kInterval},
      {"/ranges/upper", kInterval},
      {"/ranges/sensitivity", kSensitivity},
      {"/ranges/sensitivity_claim", kEqual},
      {"/ranges/primal_residual", kNot, kRoundingReason},
      {"/ranges/dual_residual", kNot, kRoundingReason},
      {"/ranges/outcome", kEqual},
      {"/equilibrium@doubtful", kEqual},
      {"/equilibrium@objectives", kEqual},
      {"/equilibrium@certified", kEqual},
      {"/equilibrium@unbounded", kEqual},
      {"/equilibrium@imprecise", kEqual},
      {"/equilibrium@failed", kEqual},
      {"/equilibrium@residual", kNot, kRoundingReason},
      {"/equilibrium@worst_primal_residual", kNot, kRoundingReason},
      {"/equilibrium@worst_dual_residual", kNot, kRoundingReason},
      {"/ranges@states", kEqual},
      {"/ranges@states_of", kEqual},
      {"/extremal/contacts", kEqual},
      {"/extremal/states", kByState},
      {"/extremal/active", kNot, "a degenerate state has several bases; a state of a basis is compared"},
      {"/extremal/rays", kNot, kProofReason},
      {"/ranges/unique", kEqual},
      {"/ranges/vertex", kByState},
      {"/ranges/ray", kNot, kProofReason},
      {"/ranges/delta_R", kNear},
      {"/ranges/delta_T", kNear},
      {"/ranges/d_R", kByState},
      {"/ranges/d_T", kByState},
      {"/ranges/R_star", kPlace},
      {"/ranges/T_star", kPlace},
      {"/ranges/d_R_min", kInterval},
      {"/ranges/d_T_min", kInterval},
      {"/ranges/d_min_lower", kInterval},
      {"/ranges/d_min_shortage", kNot, kRoundingReason},
      {"/ranges/d_min_outcome", kEqual},
      {"/extremal/norm", kByState},
      {"/extremal@largest_norm", kByState},
      {"/equilibrium@sliding", kEqual},
      {"/equilibrium@non_transmitting", kEqual},
      {"/ranges@mean_delta_R", kNot, kDrawReason},
      {"/ranges@band_delta_R", kNot, kDrawReason},
      {"/ranges@mean_delta_T", kNot, kDrawReason},
      {"/ranges@band_delta_T", kNot, kDrawReason},
      {"/ranges@estimator", kNot, kDrawReason},
      {"/ranges@calibration", kEqual},
      {"/ranges@coverage", kEqual},
      {"/ranges/calibrates", kEqual},
      {"/ranges/delta_R_estimate", kNear},
      {"/ranges/delta_R_low", kNear},
      {"/ranges/delta_R_high", kNear},
      {"/ranges/delta_T_estimate", kNear},
      {"/ranges/delta_T_low", kNear},
      {"/ranges/delta_T_high", kNear},
      {"/reactions/body", kEqual},
      {"/reactions/component", kEqual},
      {"/reactions/value", kNear},
      {"/reactions/lower", kInterval},
      {"/reactions/upper", kInterval},
      {"/reactions/outcome", kEqual},
      {"/reactions/vertex", kNot, "numbers of states; that they attain the value is for verify"},
      {"/reactions/ray", kNot, kProofReason},
      {"/reactions/states", kNot, kProofReason},
      {"/reactions/rays", kNot, kProofReason},
      {"/duals/contacts", kEqual},
      {"/duals@seed", kEqual},
      {"/duals/bounding", kSameSize},
      {"/duals/multipliers", kSameSize},
      {"/duals/points", kSameSize},
      {"/equilibrium@determined", kEqual},
      {"/provenance/work@method", kEqual},
      {"/provenance/work@reason", kEqual},
      {"/equilibrium@gap", kEqual},
      {"/equilibrium@enclosed", kEqual},
      {"/provenance/work@formulation", kEqual},
      {"/provenance/work@solves", kNot, kWorkReason},
      {"/provenance/work@pivots", kNot, kWorkReason},
      {"/provenance/work@neighbour_rule", kEqual},
      {"/provenance/work@walk_start", kEqual},
      {"/provenance/work@walk_seed", kEqual},
      {"/provenance/work@start_simulated", kNot, kWorkReason},
      {"/provenance/work@start_unknown", kNot, kWorkReason},
      {"/provenance/work@start_outside", kNot, kWorkReason},
      {"/provenance/work@start_tight_corner", kNot, kWorkReason},
      {"/provenance/work@walks_none_better", kNot, kWorkReason},
      {"/provenance/work@walks_more_active", kNot, kWorkReason},
      {"/provenance/work@walks_fewer_active", kNot, kWorkReason},
      {"/provenance/work@walks_directions_lost", kNot, kWorkReason},
      {"/provenance/work@walks_edge_without_end", kNot, kWorkReason},
      {"/provenance/work@walks_step_limit", kNot, kWorkReason},
      {"/provenance/work@sliding_left", kNot, kWorkReason},
      {"/provenance/work@extremal_points", kNot, kWorkReason},
      {"/provenance/work@unexpected_points", kNot, kWorkReason},
      {"/provenance/work@neighbours", kNot, kWorkReason},
  };
  return rules;
}

std::set<std::string> all_fields() {
  std::set<std::string> names;
  for (const auto& [path, entry] : entries_of(ForceRanges{})) names.insert(path);
  return names;
}

std::set<std::string> told_fields(const ForceRanges& ranges) {
  std::set<std::string> names;
  visit_fields(ranges, [&]<class Value>(const Field& field, const Value& value) {
    Eigen::Index rows = 1;
    if constexpr (requires { value.rows(); }) rows = value.rows();
    if (rows > 0 && is_present(field.presence, ranges, rows)) names.insert(path_of(field));
  });
  return names;
}

std::set<std::string> ruled_fields() {
  std::set<std::string> names;
  for (const RuleOfField& rule : field_rules()) {
    EXPECT_TRUE(names.insert(rule.field).second) << rule.field << " has two rules";
    EXPECT_EQ(rule.rule == FieldRule::kNot, *rule.reason != 0) << rule.field;
  }
  return names;
}

AssertionResult keeps_rules(const ForceRanges& expected, const ForceRanges& found, const Nearness& nearness) {
  const std::map<std::string, Entry> a = entries_of(expected);
  const std::map<std::string, Entry> b = entries_of(found);
  std::string broken;
  for (const RuleOfField& rule : field_rules()) {
    if (nearness.except.contains(rule.field)) continue;
    const auto same = keeps_rule(rule, a.at(rule.field), b.at(rule.field), expected, nearness);
    if (!same) broken += std::string("\n") + rule.field + " " + same.message();
  }
  if (!broken.empty()) return AssertionFailure() << broken;
  if (!nearness.except.contains("/ranges/lower")) {
    if (auto same = intervals_overlap(expected, found, nearness); !same) return same;
  }
  if (nearness.turn > 0 || nearness.except.contains("/extremal/states")) return AssertionSuccess();
  return same_extremal_states(expected, found, nearness.tolerance * (nearness.rounds ? 1e3 : 1));
}

}  // namespace indet::test
