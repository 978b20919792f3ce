#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "libindet/io/file_kind.h"

namespace indet {

/// Which files a run may replace. A file of the kind that the run writes, and an empty one, may be replaced,
/// so that a command can be run again. One of another kind, or that indet did not write, may be replaced only
/// on demand; what the run reads, never, by whatever path or link it is called. Devices and FIFOs are written
/// in place.
///
/// Asked before a run begins to compute, so that nothing is computed in vain. All functions throw InputError
/// that names the file and says what to do.
class Replacement {
 public:
  using Recogniser = std::function<std::optional<FileKind>(const std::filesystem::path&)>;

  /// `inputs`: the files that the run reads. `overwrite`: replace files of any kind. `recogniser` is asked
  /// for the kind of a file that is there.
  Replacement(std::vector<std::filesystem::path> inputs, bool overwrite, Recogniser recogniser = &recognise);

  /// Throws unless a file of this kind can be written to `output`.
  void require(const std::filesystem::path& output, FileKind kind) const;

  /// Throws if `output` is a file that the run reads.
  void require_unread(const std::filesystem::path& output) const;

  /// Throws unless files can be written into `folder` without asking for each: it is not there, is empty, or
  /// has the file `mark`, of which only the run that fills the folder makes one.
  void require_folder(const std::filesystem::path& folder, const std::filesystem::path& mark) const;

 private:
  std::vector<std::filesystem::path> inputs_;
  bool overwrite_;
  Recogniser recogniser_;
};

}  // namespace indet
