#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "libindet/io/hdf5_file.h"

namespace indet {

/// What a file that indet wrote is for.
enum class FileKind {
  kPacking,       ///< import, simulate
  kRanges,        ///< analyze
  kLimits,        ///< limit
  kSamples,       ///< sample
  kCheckpoint,    ///< simulate, on its way
  kMember,        ///< ensemble: one packing with all that is known of it
  kEnsemble,      ///< ensemble, merge: the tables of all members
  kPlan,          ///< ensemble, merge: ensemble.toml
  kAnalysisPlan,  ///< analyze --out: analysis.toml
  kPicture,       ///< export, trajectory: .svg, .pdf, .png
  kContactTable,  ///< export: one .csv
  kCsvScene,      ///< export: a file of the folder of a scene
  kVtk,           ///< export: .vtkhdf
  kParticles,     ///< export: .extxyz
  kBonds,         ///< export: the .bonds.dump beside it
  kReport,        ///< report
};

/// "a packing", "force ranges", …
const char* describe(FileKind kind);

/// The kind of an HDF5 file of indet, by the groups that it has.
FileKind kind_of(const Hdf5File& file);

/// The kind of any file, by its contents; nothing where indet did not write it. An HDF5 file must be whole
/// and in a version of the format that can be read. Throws InputError if there is no such file.
std::optional<FileKind> recognise(const std::filesystem::path& path);

}  // namespace indet
