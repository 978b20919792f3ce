#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "libindet/range/force_ranges.h"

namespace indet {

/// One column of a table of contacts in text: a field of the ranges with one number a contact
/// (range/result_fields.h). Forces are in the packing's unit of force, and their names end in _mg. An end of
/// a range, `end`, has an outcome beside its value.
struct RangeColumn {
  std::string name;
  Eigen::VectorXd values;
  std::optional<Column> end;
};

/// `mg`: the packing's unit of force in the scene's.
std::vector<RangeColumn> range_columns(const ForceRanges& ranges, double mg);

}  // namespace indet
