#include "apps/ranges_json.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <type_traits>

#include "apps/wording.h"
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
    const bool is_told = field.presence == Presence::kAlways || field.presence == Presence::kExact ||
                         field.presence == Presence::kHairline;
    if (!is_summary || !is_told || !is_present(field.presence, ranges, 1)) return;
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

nlohmann::json reactions_to_json(const Packing& packing, const Reactions& reactions) {
  nlohmann::json list = nlohmann::json::array();
  for (Eigen::Index k = 0; k < reactions.count(); ++k) {
    const Body body = Body::from_code(reactions.body[k]);
    nlohmann::json entry;
    if (body.is_wall()) {
      entry = {{"wall", packing[body.wall_id()].id}, {"name", packing[body.wall_id()].name}};
    } else {
      entry = {{"disk", packing[body.disk_id()].id}};
    }
    entry["component"] = reaction_component(body, reactions.component[k]);
    for (const int end : {0, 1}) {
      const std::string name = end == 0 ? "minimum" : "maximum";
      entry[name] = json_number(reactions.value(k, end));
      entry[name + "_bounds"] = {json_number(reactions.lower(k, end)), json_number(reactions.upper(k, end))};
      entry[name + "_outcome"] = to_string(reactions.outcome(k, end));
    }
    list.push_back(std::move(entry));
  }
  return list;
}

}  // namespace indet::app
