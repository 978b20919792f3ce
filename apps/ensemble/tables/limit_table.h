#pragma once

#include <cstddef>
#include <vector>

#include "apps/ensemble/tables/flat_table.h"
#include "libindet/packing/packing.h"

namespace indet {

/// Columns of limits (members/limits_step.h) in /table/runs. Values are missing where limits were not asked
/// for, where a packing does not stand as it is, and where a limit could not be proven.
std::vector<FlatTable::Column> limit_columns();

/// Of the packing of row `run`, from the file of the member that holds it. Throws InputError.
void add_limits(const Hdf5File& file, const Packing& packing, std::size_t run, FlatTable& runs);

}  // namespace indet
