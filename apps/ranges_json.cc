#include "apps/ranges_json.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>
#include <type_traits>

#include "libindet/range/result_fields.h"

namespace indet::app {

nlohmann::json json_number(double value) {
  if (std::isfinite(value)) return value;
  if (std::isnan(value)) return nullptr;
  return value > 0 ? "inf" : "-inf";
}

nlohmann::json summary_to_json(const ForceRanges& ranges) {
  nlohmann::json json = {{"requested", ranges.requested}};
  visit_fields(ranges, [&]<class Value>(const Field& field, const Value& value) {
    const std::string_view group = field.group;
    const bool is_summary = group == "/equilibrium" || group == "/provenance/work";
    if (!is_summary || field.presence != Presence::kAlways) return;
    if constexpr (std::is_same_v<Value, double>) {
      json[field.name] = json_number(value);
    } else if constexpr (std::is_enum_v<Value>) {
      json[field.name] = to_string(value);
    } else if constexpr (
        requires { nlohmann::json(value); } && !requires { value.rows(); }) {
      json[field.name] = value;
    }
  });
  return json;
}

}  // namespace indet::app
