#pragma once

#include <string>
#include <vector>

#include "libindet/io/hdf5_session.h"

namespace indet::hdf5 {

/// SHA-256 (64 hexadecimal digits) over all numbers below `roots`: those of datasets, whatever their storage,
/// and those of attributes, in the order of the keys OBJECT and OBJECT@ATTRIBUTE. Each enters as
///
///     key, 0, rank, extents, values          (integers i8, reals as their bits, all little-endian)
///
/// docs/file-format.md defines it so that it can be recomputed with h5py. Text does not enter.
std::string sha256(const Session& session, const std::vector<std::string>& roots);

}  // namespace indet::hdf5
