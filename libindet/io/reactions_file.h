#pragma once

#include "libindet/io/hdf5_file.h"
#include "libindet/range/reactions.h"

namespace indet {

/// /reactions (docs/file-format.md): the ranges of what walls and fixed disks bear. Files of packings without
/// either have none, and earlier versions wrote none.
void write_reactions_part(Hdf5File& file, const Reactions& reactions);

/// Throws InputError where a row names no body of the packing, or no state.
Reactions read_reactions(const Hdf5File& file);

}  // namespace indet
