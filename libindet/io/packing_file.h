#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "libindet/io/hdf5_file.h"
#include "libindet/packing/packing.h"

namespace indet {

/// What is written about the run that makes a file. Version, commit, compiler, host, time and the versions of
/// HDF5 and Eigen are added to it.
struct Provenance {
  std::vector<std::string> arguments;            ///< argv
  std::string config;                            ///< The resolved configuration of the run, TOML.
  std::map<std::string, std::string> libraries;  ///< Version by name, of the libraries that took part.
  std::map<std::string, double> seconds;         ///< By stage.
};

/// Writes a file that holds one packing (docs/file-format.md). Throws InputError where the path cannot be
/// written, Hdf5WriteError if writing fails; either way no file appears and an old one stays.
void write_packing(const std::filesystem::path& path, const Packing& packing, const Provenance& provenance);

/// Reads the packing of any file that indet wrote, and validates it. Throws InputError.
Packing read_packing(const std::filesystem::path& path);

/// The SHA-256 of the numbers of a file: as stored in it, and recomputed from what is in it now.
struct Digests {
  std::string content;         ///< Of everything outside /provenance.
  std::string stored_content;  ///< @content_sha256 of the root.
  std::string ranges;          ///< Of /ranges and /extremal; empty if the file has no ranges.
  std::string stored_ranges;   ///< @sha256 of /ranges; empty if the file has no ranges.

  bool match() const { return content == stored_content && ranges == stored_ranges; }
};
Digests compute_digests(const std::filesystem::path& path);

/// Opens a file and makes sure that indet wrote it, completely, in a version of the format that can be read.
Hdf5File open_indet_file(const std::filesystem::path& path);

/// The parts of such a file, for the writers of files that hold more than a packing.
void write_header(Hdf5File& file);
void write_packing_part(Hdf5File& file, const Packing& packing);
Packing read_packing_part(const Hdf5File& file);
void write_provenance_part(Hdf5File& file, const Provenance& provenance);
/// Stores the digest of the contents, marks the file complete and commits it.
void seal(Hdf5File& file);

}  // namespace indet
