#include "apps/ensemble/tables/limit_table.h"

#include <fmt/format.h>

#include <array>
#include <string>

#include "apps/ensemble/members/limits_step.h"
#include "libindet/io/limits_file.h"

namespace indet {
namespace {

/// One end of a limit as columns: its value and, by further names, the state there.
struct EndColumns {
  const char* limit;
  bool is_largest;
  const char* column;
  const char* unit;
  const char* long_name;
};
constexpr std::array<EndColumns, 6> kEnds = {{
    {limit_name::kTilt, false, "tilt_smallest", "rad", "smallest angle by which gravity can be turned"},
    {limit_name::kTilt, true, "tilt_largest", "rad", "largest angle by which gravity can be turned"},
    {limit_name::kTiltOfSeveral, false, "tilt_of_several_smallest", "rad",
     "the same once disks that move alone are taken out, smallest angle"},
    {limit_name::kTiltOfSeveral, true, "tilt_of_several_largest", "rad", "the same, largest angle"},
    {limit_name::kLoadOnTop, true, "load_on_top", "mg", "largest load along gravity on the highest disk"},
    {limit_name::kFriction, false, "least_friction", "1", "least factor of all coefficients of friction"},
}};

constexpr const char* kLeftOut = "tilt_left_out";
constexpr const char* kBound = "tilt_of_several_lower_bound";

void add_end(const EndColumns& columns, const Limit& limit, std::size_t run, FlatTable& runs) {
  const LimitEnd& end = columns.is_largest ? limit.largest : limit.smallest;
  if (!limit.stands() || !limit.is_decided()) return;
  runs.set(columns.column, run, end.value);
  runs.set(fmt::format("{}_sliding", columns.column), run, end.sliding);
  runs.set(fmt::format("{}_dim", columns.column), run, end.dim);
}

}  // namespace

std::vector<FlatTable::Column> limit_columns() {
  std::vector<FlatTable::Column> columns;
  for (const EndColumns& end : kEnds) {
    columns.push_back(FlatTable::real(end.column, end.unit, end.long_name));
    columns.push_back(FlatTable::integer(
        fmt::format("{}_sliding", end.column),
        "sliding contacts of the state there; one that transmits nothing counts twice; -1: not known"));
    columns.push_back(FlatTable::integer(fmt::format("{}_dim", end.column),
                                         "dimension of the states that are left there; -1: not known"));
  }
  columns.push_back(FlatTable::integer(kLeftOut, "disks that move alone, taken out"));
  columns.push_back(FlatTable::integer(kBound, "2M - 3N without them"));
  return columns;
}

void add_limits(const Hdf5File& file, const Packing& packing, std::size_t run, FlatTable& runs) {
  if (!has_limits(file)) return;
  for (const Limit& limit : read_limits(file)) {
    for (const EndColumns& columns : kEnds) {
      if (limit.name == columns.limit) add_end(columns, limit, run, runs);
    }
    if (limit.name != limit_name::kTiltOfSeveral) continue;
    runs.set(kLeftOut, run, static_cast<double>(limit.left_out.size()));
    runs.set(kBound, run, without(packing, limit.left_out).expected_dimension());
  }
}

}  // namespace indet
