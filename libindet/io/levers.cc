#include "libindet/io/levers.h"

#include <fmt/format.h>

#include "libindet/base/error.h"
#include "libindet/base/printable.h"

namespace indet {
namespace {

std::optional<Lever> parse_lever(const std::string& text) {
  if (text == "radius") return Lever::kRadius;
  if (text == "mid-overlap") return Lever::kMidOverlap;
  return {};
}

}  // namespace

std::string name_of(Lever lever) { return lever == Lever::kRadius ? "radius" : "mid-overlap"; }

std::string name_of(const Levers& levers) {
  return fmt::format("pair={},wall={}", name_of(levers.pair), name_of(levers.wall));
}

LeverRule LeverRule::parse(const std::vector<std::string>& items) {
  LeverRule rule;
  for (const std::string& item : items) {
    const bool pair = !item.starts_with("wall=");
    const bool wall = !item.starts_with("pair=");
    const auto lever = parse_lever(pair && wall ? item : item.substr(5));
    if (!lever) {
      throw InputError(
          fmt::format("lever \"{}\": the forms are radius, mid-overlap, pair=… and wall=…", excerpt(item)));
    }
    if ((pair && rule.pair) || (wall && rule.wall)) {
      throw InputError(fmt::format("lever \"{}\": this is given twice", excerpt(item)));
    }
    if (pair) rule.pair = lever;
    if (wall) rule.wall = lever;
  }
  return rule;
}

}  // namespace indet
