#include "libindet/io/density_rule.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string_view>

#include "libindet/base/error.h"
#include "libindet/base/printable.h"
#include "libindet/io/table.h"

namespace indet {

DensityRule DensityRule::parse(const std::vector<std::string>& items) {
  DensityRule rule;
  for (const std::string& item : items) rule.add(item);
  return rule;
}

void DensityRule::add(const std::string& item) {
  const auto refuse = [&](const std::string& reason) {
    throw InputError(fmt::format("density \"{}\": {}", excerpt(item), reason));
  };
  const std::string forms = "the forms are sphere=2500, disk=1.27, sphere:1=2500, disk:1=1.27";
  const std::size_t equals = item.find('=');
  if (equals == std::string::npos) refuse(forms);
  const std::string_view key = std::string_view(item).substr(0, equals);
  const std::size_t colon = key.find(':');
  const std::string_view shape = key.substr(0, colon);
  std::int64_t type = 0;
  const bool has_type = colon != std::string_view::npos;
  double density = 0;
  if ((shape != "sphere" && shape != "disk") || (has_type && !parse_number(key.substr(colon + 1), &type)) ||
      type < 0 || type > std::numeric_limits<int>::max() ||
      !parse_number(std::string_view(item).substr(equals + 1), &density)) {
    refuse(forms);
  }
  if (!(density > 0) || !std::isfinite(density)) refuse("the density must be positive");
  const bool spheres = shape == "sphere";
  if (!empty() && spheres != spheres_) refuse("particles are all spheres or all disks");
  spheres_ = spheres;
  const bool is_new = has_type ? by_type_.emplace(static_cast<int>(type), density).second : !all_;
  if (!is_new) refuse("this is given twice");
  if (!has_type) all_ = density;
}

std::optional<Inertia> DensityRule::of_particle(double radius, int type) const {
  const auto found = by_type_.find(type);
  if (found == by_type_.end() && !all_) return {};
  const double density = found == by_type_.end() ? *all_ : found->second;
  const double square = radius * radius;
  const double mass = density * std::numbers::pi * square * (spheres_ ? 4 * radius / 3 : 1);
  return Inertia{.mass = mass, .moment = (spheres_ ? 0.4 : 0.5) * mass * square};
}

}  // namespace indet
