#pragma once

#include <filesystem>

#include "libindet/io/packing_file.h"
#include "libindet/range/force_ranges.h"

namespace indet {

/// Writes a packing and its force ranges into one file (docs/file-format.md), so that the file can be checked
/// and drawn without any other, also by readers of VTK (io/vtkhdf.h). `ranges.seconds` joins the timings of
/// `provenance`. Throws like write_packing; the rows of the tables must be the contacts of the packing.
void write_ranges(const std::filesystem::path& path, const Packing& packing, const ForceRanges& ranges,
                  const Provenance& provenance);

/// Reads the force ranges of a file. Throws InputError if it has none, or if a table has not the size of the
/// packing or points to a state that is not there.
ForceRanges read_ranges(const Hdf5File& file);
ForceRanges read_ranges(const std::filesystem::path& path);

/// The parts of such a file, for the writers of files that hold more: /equilibrium, /ranges and /extremal;
/// and what the search did, which belongs to /provenance and needs it to be there.
void write_ranges_part(Hdf5File& file, const ForceRanges& ranges);
void write_work_part(Hdf5File& file, const ForceRanges& ranges);

bool has_ranges(const Hdf5File& file);

}  // namespace indet
