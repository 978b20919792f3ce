#pragma once

#include <vector>

#include "apps/ensemble/tables/ensemble_tables.h"
#include "libindet/io/hdf5_file.h"
#include "libindet/packing/packing.h"

namespace indet {

/// The columns of /table/contacts, one row a contact, and of /table/extremal, one row a bin.
std::vector<FlatTable::Column> contact_columns();
std::vector<FlatTable::Column> extremal_columns();

/// New rows of both for the packing of row `run`, from the file of the member that holds it. What uniform
/// sampling found is still missing in them. Throws InputError.
void add_contacts(const Hdf5File& file, const Packing& packing, std::size_t run, EnsembleTables& tables);

}  // namespace indet
