#include "libindet/io/contact_columns.h"

#include <string_view>

#include "libindet/range/result_fields.h"

namespace indet {

std::vector<RangeColumn> range_columns(const ForceRanges& ranges, double mg) {
  std::vector<RangeColumn> columns;
  visit_fields(ranges, [&]<class Value>(const Field& field, const Value& value) {
    if constexpr (requires { requires Value::ColsAtCompileTime == 1; }) {
      if (field.rows != Extent::kContacts || !is_present(field.presence, ranges, value.rows())) return;
      RangeColumn& column = columns.emplace_back(RangeColumn{field.name, value.template cast<double>(), {}});
      for (const Column end : {kMinR, kMaxR, kMinT, kMaxT}) {
        if (column.name == to_string(end)) column.end = end;
      }
      const std::string_view unit = field.unit;
      if (unit == "force") column.values /= mg;
      if (unit == "force" || unit == "mg") column.name += "_mg";
    }
  });
  return columns;
}

}  // namespace indet
