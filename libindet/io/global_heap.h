#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace indet {

/// The byte at which a global heap of an HDF5 file is damaged, nothing if none is. Global heaps hold strings
/// of variable length (HDF5 File Format Specification 3.0, III.E: "GCOL", version 1, then objects of index,
/// reference count and size). HDF5 1.10 reads one with an object of index 0 and size 0 for ever, and checks
/// no other size. Sizes are taken to have 8 bytes, as in all files of 64-bit machines. Files that cannot be
/// read have no heaps.
std::optional<std::uint64_t> find_damaged_heap(const std::filesystem::path& path);

}  // namespace indet
