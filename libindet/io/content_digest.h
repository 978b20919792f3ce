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
/// docs/file-format.md defines it so that it can be recomputed with h5py. Text does not enter: what is
/// computed has the same digest, whatever the files were called that it was computed from.
std::string sha256(const Session& session, const std::vector<std::string>& roots);

/// The same over all texts below `roots`, each with its length (i8) before its bytes, and over the attributes
/// of the root. What tells of the digests themselves does not enter: attributes `sha256`, and of the root
/// `content_sha256`, `text_sha256`, and `complete`, which comes last.
std::string text_sha256(const Session& session, const std::vector<std::string>& roots);

}  // namespace indet::hdf5
