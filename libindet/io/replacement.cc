#include "libindet/io/replacement.h"

#include <fmt/format.h>

#include <string>
#include <system_error>
#include <utility>

#include "libindet/base/error.h"
#include "libindet/io/destination.h"

namespace indet {
namespace {

namespace fs = std::filesystem;

constexpr const char* kAdvice = "choose another name, or replace it with --overwrite";

[[noreturn]] void refuse(const fs::path& path, const std::string& reason) {
  throw InputError(fmt::format("{}: {}", path.string(), reason));
}

/// The same device and inode.
bool is_same_file(const fs::path& a, const fs::path& b) {
  std::error_code ignored;
  return fs::equivalent(a, b, ignored);
}

}  // namespace

Replacement::Replacement(std::vector<fs::path> inputs, bool overwrite, Recogniser recogniser)
    : inputs_(std::move(inputs)), overwrite_(overwrite), recogniser_(std::move(recogniser)) {}

void Replacement::require(const fs::path& output, FileKind kind) const {
  const Destination destination = destination_of(output);
  std::error_code error;
  if (destination.is_stream || !fs::exists(destination.path, error)) return;
  require_unread(output);
  if (overwrite_ || fs::file_size(destination.path, error) == 0) return;
  const std::optional<FileKind> found = recogniser_(destination.path);
  if (!found) {
    refuse(output, fmt::format("is there already, and not a file that indet wrote whole; {}", kAdvice));
  }
  if (*found == kind) return;
  refuse(output,
         fmt::format("holds {}, and would be replaced by {}; {}", describe(*found), describe(kind), kAdvice));
}

void Replacement::require_unread(const fs::path& output) const {
  for (const fs::path& input : inputs_) {
    if (!is_same_file(input, output)) continue;
    refuse(output, input == output
                       ? std::string("this run reads it; choose another name for the output")
                       : fmt::format("is the file {}, which this run reads; choose another name for the "
                                     "output",
                                     input.string()));
  }
}

void Replacement::require_folder(const fs::path& folder, const fs::path& mark) const {
  std::error_code error;
  if (!fs::exists(folder, error)) return;
  if (!fs::is_directory(folder, error)) refuse(folder, "is a file; a folder of this name is to be filled");
  if (overwrite_ || fs::is_empty(folder, error) || fs::exists(folder / mark, error)) return;
  refuse(folder,
         "holds files that this run did not make and might replace; move them, or go on with "
         "--overwrite");
}

}  // namespace indet
