#pragma once

#include <vector>

#include "apps/ensemble/tables/ensemble_tables.h"
#include "libindet/io/hdf5_file.h"

namespace indet {

/// Columns of uniform sampling in the tables of an ensemble: of /table/runs and of /table/contacts. They are
/// missing values (NaN, "") for packings that were not sampled uniformly.
std::vector<FlatTable::Column> uniform_run_columns();
std::vector<FlatTable::Column> uniform_contact_columns();
/// Of /table/sampled: how the normal forces of a packing are distributed under both samplings.
std::vector<FlatTable::Column> sampled_columns();

/// What a member file says about uniform sampling: the columns of its row of /table/runs, of the rows of its
/// contacts, which begin at `first_contact`, and further rows of /table/sampled.
void add_uniform_sampling(const Hdf5File& file, EnsembleTables& tables, std::size_t run,
                          std::size_t first_contact);

}  // namespace indet
