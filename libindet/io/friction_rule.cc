#include "libindet/io/friction_rule.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>

#include "libindet/base/error.h"
#include "libindet/base/printable.h"
#include "libindet/io/table.h"

namespace indet {
namespace {

double checked(double friction, std::string_view text) {
  if (!(friction >= 0) || !std::isfinite(friction)) {
    throw InputError(fmt::format("the friction coefficient must be a number ≥ 0, but is {}", text));
  }
  return friction;
}

[[noreturn]] void refuse(const std::string& item) {
  throw InputError(fmt::format(
      "friction \"{}\": the forms are 0.3, disk=0.4, wall=0, wall:NAME=0.2, type:1-2=0.3", excerpt(item)));
}

bool is_type(std::int64_t number) { return number >= 0 && number <= std::numeric_limits<int>::max(); }

/// "1-2", the smaller one first.
std::pair<int, int> parse_types(std::string_view text, const std::string& item) {
  const std::size_t dash = text.find('-');
  std::int64_t first = 0;
  std::int64_t second = 0;
  if (dash == std::string_view::npos || !parse_number(text.substr(0, dash), &first) ||
      !parse_number(text.substr(dash + 1), &second) || !is_type(first) || !is_type(second)) {
    refuse(item);
  }
  return std::minmax(static_cast<int>(first), static_cast<int>(second));
}

}  // namespace

FrictionRule::FrictionRule(double friction) : all_(checked(friction, fmt::format("{}", friction))) {}

FrictionRule FrictionRule::parse(const std::vector<std::string>& items) {
  FrictionRule rule;
  for (const std::string& item : items) rule.add(item);
  return rule;
}

void FrictionRule::add(const std::string& item) {
  const std::size_t equals = item.rfind('=');
  const std::string key = equals == std::string::npos ? "" : item.substr(0, equals);
  const std::string text = equals == std::string::npos ? item : item.substr(equals + 1);
  double value = 0;
  if (!parse_number(text, &value)) refuse(item);
  value = checked(value, text);
  bool is_new = true;
  const auto set = [&](std::optional<double>& place) {
    is_new = !place;
    place = value;
  };
  if (equals == std::string::npos) {
    set(all_);
  } else if (key == "disk") {
    set(disk_);
  } else if (key == "wall") {
    set(wall_);
  } else if (key.starts_with("wall:") && key.size() > 5) {
    is_new = walls_.emplace(key.substr(5), value).second;
  } else if (key.starts_with("type:")) {
    is_new = types_.emplace(parse_types(std::string_view(key).substr(5), item), value).second;
  } else {
    refuse(item);
  }
  if (!is_new) throw InputError(fmt::format("friction \"{}\": this is given twice", excerpt(item)));
}

std::optional<double> FrictionRule::of_disks(int type_a, int type_b) const {
  const std::pair<int, int> key = std::minmax(type_a, type_b);
  if (const auto found = types_.find(key); found != types_.end()) return found->second;
  return disk_ ? disk_ : all_;
}

std::optional<double> FrictionRule::of_wall(const std::vector<std::string>& names) const {
  for (const std::string& name : names) {
    if (const auto found = walls_.find(name); found != walls_.end()) return found->second;
  }
  return wall_ ? wall_ : all_;
}

}  // namespace indet
