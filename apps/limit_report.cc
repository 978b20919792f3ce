#include "apps/limit_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "apps/ranges_json.h"
#include "apps/say.h"
#include "apps/step_report.h"
#include "apps/wording.h"
#include "libindet/base/constants.h"
#include "libindet/limit/mechanism.h"
#include "libindet/limit/tilt.h"

namespace indet::app {
namespace {

constexpr std::size_t kMostNamed = 8;  ///< disks

std::string number_text(const Limit& limit, double value) {
  if (limit.kind == LimitKind::kTilt) return fmt::format("{:.6g}°", value * 180 / std::numbers::pi);
  return fmt::format("{:.10g}", value);
}

/// How wide the proven interval of an end is.
std::string width_text(const Limit& limit, const LimitEnd& end) {
  const double width = end.upper - end.lower;
  return fmt::format("{:.1e}{}", width, limit.kind == LimitKind::kTilt ? " rad" : "");
}

std::string disks_text(const Packing& packing, const std::vector<DiskId>& disks) {
  std::string text = counted(std::ssize(disks), "disk");
  text += std::ssize(disks) == 1 ? " moves" : " move";
  std::string names;
  for (std::size_t k = 0; k < std::min(disks.size(), kMostNamed); ++k)
    names += fmt::format("{}{}", k == 0 ? "" : ", ", packing[disks[k]].id);
  if (disks.size() > kMostNamed) names += ", …";
  return names.empty() ? text : fmt::format("{} ({})", text, names);
}

struct MotionCount {
  int open = 0, slide = 0;
};
MotionCount count_motions(const Packing& packing, const exact::BodyMotion& motion) {
  MotionCount count;
  for (const ContactMotion what : contact_motions(packing, motion)) {
    count.open += what == ContactMotion::kOpens ? 1 : 0;
    count.slide += what == ContactMotion::kSlides ? 1 : 0;
  }
  return count;
}

void print_end(const Packing& whole, const Limit& limit, const LimitEnd& end, bool is_largest) {
  const Packing packing = without(whole, limit.left_out);
  const char* name = is_largest ? "largest" : "smallest";
  switch (end.outcome) {
    case LimitOutcome::kReached:
      say("  {:<9} {} (proven to {})\n", name, number_text(limit, end.value), width_text(limit, end));
      break;
    case LimitOutcome::kNever:
      say("  {:<9} never: {}\n", name,
          limit.kind == LimitKind::kTilt ? "it stands whichever way gravity points"
                                         : "it stands under any multiple of the load");
      return;
    case LimitOutcome::kNoState:
      return;
    case LimitOutcome::kUndecided:
      if (end.lower > -kInfinity && end.upper < kInfinity)
        say("  {:<9} between {} and {}\n", name, number_text(limit, end.lower),
            number_text(limit, end.upper));
      else
        say("  {:<9} undecided\n", name);
      return;
  }
  if (end.motion.disks.rows() == 0) return;
  const MotionCount count = count_motions(under_mechanism(whole, limit, end), end.motion);
  say("            there {}: {} open, {} slide{}\n", disks_text(packing, moving_disks(end.motion)),
      counted(count.open, "contact"), count.slide,
      end.has_one_mechanism ? "" : "; other motions may be possible, too");
  if (end.sliding >= 0)
    say("            {}, {}{}\n", describe_sliding(end.sliding, end.non_transmitting),
        describe_expected_dimension(packing), end.dim < 0 ? "" : fmt::format("; dim F = {}", end.dim));
  print_steps(limit, end);
}

/// "all", "12 of 68".
std::string counted_scaled(const Limit& limit) {
  const auto count = std::count(limit.scaled.begin(), limit.scaled.end(), true);
  if (count == std::ssize(limit.scaled)) return "all";
  return fmt::format("{} of {}", count, limit.scaled.size());
}

void print_friction(const Packing& packing, const Limit& limit) {
  say("{}: the least factor of the coefficients of friction of {} contacts\n", limit.name,
      counted_scaled(limit));
  const LimitEnd& end = limit.smallest;
  if (end.outcome == LimitOutcome::kNoState) {
    say("  no friction suffices{}\n",
        std::isinf(end.lower) ? "" : fmt::format(" (proven up to {:.3g} times of what there is)", end.lower));
  } else if (end.outcome == LimitOutcome::kReached && end.value == 0 && limit.is_attained) {
    say("  no friction is needed\n");
    return print_steps(limit, end);
  } else if (end.outcome == LimitOutcome::kReached && end.value == 0) {
    say("  with {:.1e} times the friction that there is it still stands, with none it does not\n", end.upper);
  } else {
    if (limit.falls()) say("  it cannot stand as it is\n");
    print_end(packing, limit, end, false);
    if (end.outcome == LimitOutcome::kReached && !limit.is_attained)
      say("            with this factor itself it seems not to stand: forces grow without limit towards "
          "it\n");
    return;
  }
  if (end.motion.disks.rows() > 0) say("            {}\n", disks_text(packing, moving_disks(end.motion)));
  print_steps(limit, end);
}

void print_limit(const Packing& whole, const Limit& limit) {
  const Packing packing = without(whole, limit.left_out);
  if (limit.kind == LimitKind::kFriction) return print_friction(packing, limit);
  if (limit.kind == LimitKind::kTilt)
    say("{}: gravity turned counter-clockwise\n", limit.name);
  else
    say("load {}: a multiple of it acts, too\n", limit.name);
  for (const DiskId disk : limit.left_out)
    say("  without disk {}, which moves first, alone, and without which it stands\n", whole[disk].id);
  if (limit.largest.outcome == LimitOutcome::kNoState) {
    say("  no contact forces balance it{}\n",
        limit.kind == LimitKind::kTilt
            ? limit.is_first_of_several ? " as it stands" : ", whichever way gravity points"
            : ", whatever the multiple");
    say("            {}\n", disks_text(packing, moving_disks(limit.largest.motion)));
    return;
  }
  if (limit.falls()) say("  it cannot stand as it is, only between these\n");
  print_end(whole, limit, limit.smallest, false);
  print_end(whole, limit, limit.largest, true);
  if (limit.is_first_of_several)
    say("  beyond these angles it may stand again: {}\n",
        is_under_gravity_alone(packing) ? "in the opposite direction"
                                        : "something acts that does not turn with gravity");
}

/// The largest multiple in each direction of the plane of two loads.
void print_map(const std::vector<Limit>& limits) {
  std::vector<std::pair<double, std::string>> rows;
  const auto add = [&](const LimitEnd& end, double angle, int sign) {
    const std::string text = end.outcome == LimitOutcome::kReached ? fmt::format("{:.10g}", sign * end.value)
                                                                   : std::string(to_string(end.outcome));
    rows.emplace_back(angle, text);
  };
  for (const Limit& limit : limits) {
    if (std::isnan(limit.map_angle)) continue;
    add(limit.largest, limit.map_angle, 1);
    add(limit.smallest, limit.map_angle + std::numbers::pi, -1);
  }
  if (rows.empty()) return;
  std::sort(rows.begin(), rows.end());
  say("largest multiple of (cos φ) times the first load and (sin φ) times the second\n  {:>8}  multiple\n",
      "φ");
  for (const auto& [angle, text] : rows) say("  {:>7.2f}°  {}\n", angle * 180 / std::numbers::pi, text);
}

std::string status_of(const Limit& limit) {
  if (limit.smallest.outcome == LimitOutcome::kNoState) return "no state";
  if (limit.falls()) return "does not stand";
  return limit.stands() && limit.is_decided() ? "stands" : "undecided";
}

MotionCount count_motions(const Packing& packing, const Limit& limit, const LimitEnd& end) {
  return count_motions(under_mechanism(packing, limit, end), end.motion);
}

nlohmann::json end_to_json(const Packing& packing, const Limit& limit, const LimitEnd& end) {
  nlohmann::json json = {{"outcome", to_string(end.outcome)}};
  if (end.sliding >= 0) {
    json["sliding"] = end.sliding;
    json["non_transmitting"] = end.non_transmitting;
  }
  if (end.dim >= 0) json["dim"] = end.dim;
  if (!end.steps.empty()) json["steps"] = steps_to_json(end.steps);
  if (end.motion.disks.rows() > 0) {
    const MotionCount count = count_motions(packing, limit, end);
    json["opening"] = count.open;
    json["slipping"] = count.slide;
    json["moving_disks"] = nlohmann::json::array();
    for (const DiskId disk : moving_disks(end.motion)) json["moving_disks"].push_back(packing[disk].id);
    json["one_mechanism"] = end.has_one_mechanism;
  }
  return json;
}

}  // namespace

void print_limits(const Packing& packing, const std::vector<Limit>& limits) {
  bool has_mechanism = false;
  print_map(limits);
  for (const Limit& limit : limits) {
    if (!std::isnan(limit.map_angle)) continue;
    print_limit(packing, limit);
    for (const LimitEnd* end : {&limit.smallest, &limit.largest})
      has_mechanism = has_mechanism || end->outcome == LimitOutcome::kReached;
  }
  if (has_mechanism)
    say("motions are those of associated sliding: a contact that slides opens by μ times as much. A real "
        "packing\n"
        "may yield before these limits are reached.\n");
}

nlohmann::json limits_to_json(const Packing& packing, const std::vector<Limit>& limits) {
  nlohmann::json list = nlohmann::json::array();
  for (const Limit& limit : limits) {
    nlohmann::json json = {
        {"load", limit.name},
        {"unit", limit.kind == LimitKind::kTilt ? "rad" : "1"},
        {"smallest", json_number(limit.smallest.value)},
        {"largest", json_number(limit.largest.value)},
        {"smallest_bounds", {json_number(limit.smallest.lower), json_number(limit.smallest.upper)}},
        {"largest_bounds", {json_number(limit.largest.lower), json_number(limit.largest.upper)}},
        {"first_of_several", limit.is_first_of_several},
        {"attained", limit.is_attained},
        {"map_angle", json_number(limit.map_angle)},
        {"status", status_of(limit)},
        {"at_smallest", end_to_json(packing, limit, limit.smallest)},
        {"at_largest", end_to_json(packing, limit, limit.largest)}};
    json["left_out"] = nlohmann::json::array();
    for (const DiskId disk : limit.left_out) json["left_out"].push_back(packing[disk].id);
    list.push_back(std::move(json));
  }
  return {{"limits", list}};
}

}  // namespace indet::app
