#pragma once

#include <filesystem>
#include <vector>

#include "libindet/io/packing_file.h"
#include "libindet/limit/limit.h"

namespace indet {

/// Writes the limits of a packing, whose part is in the file already (docs/file-format.md).
void write_limits_part(Hdf5File& file, const Packing& packing, const std::vector<Limit>& limits);

/// Writes a packing and its limits into one file. Throws like write_packing.
void write_limits(const std::filesystem::path& path, const Packing& packing, const std::vector<Limit>& limits,
                  const Provenance& provenance);

/// Reads the limits of a file. Throws InputError if it has none, or if a table has not the size of the
/// packing.
std::vector<Limit> read_limits(const Hdf5File& file);

bool has_limits(const Hdf5File& file);

}  // namespace indet
