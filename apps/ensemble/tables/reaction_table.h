#pragma once

#include <vector>

#include "apps/ensemble/tables/flat_table.h"
#include "libindet/packing/packing.h"

namespace indet {

/// The columns of /table/reactions, one row a sum over the contacts of a wall.
std::vector<FlatTable::Column> reaction_columns();

/// New rows for the packing of row `run`, from the file of the member that holds it; none where it is of a
/// version that did not compute them. Throws InputError.
void add_reactions(const Hdf5File& file, const Packing& packing, std::size_t run, FlatTable& table);

}  // namespace indet
