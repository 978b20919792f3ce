#pragma once

#include <vector>

#include "apps/ensemble/members/plan.h"
#include "apps/ensemble/tables/ensemble_tables.h"
#include "libindet/io/hdf5_file.h"
#include "libindet/packing/packing.h"

namespace indet {

/// The columns of /table/runs and of /provenance/members, one row a packing.
std::vector<FlatTable::Column> run_columns();
std::vector<FlatTable::Column> timing_columns();

/// A new row of both, from the file of a member that holds this packing; its number. Distances to other
/// packings and what uniform sampling found are still missing in it. Throws InputError.
std::size_t add_run(const Member& member, const Hdf5File& file, const Packing& packing,
                    EnsembleTables& tables);

}  // namespace indet
