#pragma once

#include <filesystem>
#include <string>

#include "libindet/io/indet_file.h"
#include "libindet/packing/packing.h"

namespace indet {

/// Writes a file that holds one packing (docs/file-format.md). Throws InputError where the path cannot be
/// written, LibraryError if writing fails; either way no file appears and an old one stays.
void write_packing(const std::filesystem::path& path, const Packing& packing, const Provenance& provenance);

/// Reads the packing of any file that indet wrote, and validates it. Throws InputError.
Packing read_packing(const Hdf5File& file);
Packing read_packing(const std::filesystem::path& path);

/// SHA-256 of the numbers of the packing of a file.
std::string packing_digest(const Hdf5File& file);

// For the writers of files that hold more.
/// 2.0 where the packing has a lever, a fixed disk or a loaded wall, which readers of 1.0 would pass over;
/// else 1.1.
SchemaVersion schema_of(const Packing& packing);
/// The part of a file that is its packing.
void write_packing_part(Hdf5File& file, const Packing& packing);

}  // namespace indet
