#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "libindet/io/hdf5_file.h"

namespace indet {

/// What all HDF5 files of indet have, whatever their kind (docs/file-format.md): a header, an account of the
/// run that made them, and a digest of their numbers. A reader opens a file once and passes it on to the
/// readers of its parts:
///
///     const Hdf5File file = open_indet_file(path);
///     if (kind_of(file) == FileKind::kRanges) use(read_packing(file), read_ranges(file));

/// What is written about the run that makes a file. Version, commit, compiler, host, time and the versions of
/// HDF5 and Eigen are added to it.
struct Provenance {
  std::vector<std::string> arguments;            ///< argv
  std::string config;                            ///< The resolved configuration of the run, TOML.
  std::map<std::string, std::string> libraries;  ///< Version by name, of the libraries that took part.
  std::map<std::string, double> seconds;         ///< By stage.
  std::string part_of = {};  ///< Digest of the analysis of whose contacts the file has some; empty: none.
};

/// Opens a file and makes sure that indet wrote it, completely, in a version of the format that can be read.
/// Throws InputError.
Hdf5File open_indet_file(const std::filesystem::path& path);

/// The SHA-256 of the numbers and of the texts of a file: as stored in it, and recomputed from what is in it
/// now.
struct Digests {
  std::string content;         ///< Of everything outside /provenance.
  std::string stored_content;  ///< @content_sha256 of the root.
  std::string texts;           ///< Of all texts outside /provenance and /h5md, and of the root's attributes.
  std::string stored_texts;    ///< @text_sha256 of the root; empty in files of earlier versions.
  std::string ranges;          ///< Of /ranges and /extremal; empty if the file has no ranges.
  std::string stored_ranges;   ///< @sha256 of /ranges; empty if the file has no ranges.

  bool numbers_match() const { return content == stored_content && ranges == stored_ranges; }
  bool texts_match() const { return stored_texts.empty() || texts == stored_texts; }
  bool match() const { return numbers_match() && texts_match(); }
};
Digests compute_digests(const Hdf5File& file);
Digests compute_digests(const std::filesystem::path& path);

/// The version of the format that a file is written in: one with a higher first number has what older readers
/// would pass over and so misunderstand (docs/file-format.md).
struct SchemaVersion {
  std::int64_t major = 1, minor = 1;
};

// For the writers of such files.
void write_header(Hdf5File& file, SchemaVersion schema = {});
void write_provenance_part(Hdf5File& file, const Provenance& provenance);
/// Stores the digest of the contents, marks the file complete and commits it.
void seal(Hdf5File& file);

}  // namespace indet
