#include "apps/packing_input.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <string_view>

#include "apps/ensemble/members/folder.h"
#include "apps/trial_reading.h"
#include "libindet/base/error.h"
#include "libindet/io/file_kind.h"

namespace indet::app {
namespace {

namespace fs = std::filesystem;

bool is_there(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

/// The first bytes of a file.
std::string beginning(const fs::path& path) {
  std::string bytes(5, '\0');
  std::ifstream stream(path, std::ios::binary);
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(stream.gcount()));
  return bytes;
}

/// "; its packings are in e/members: choose one of those, for example e/members/cd1-0000.h5".
std::string advice_on_ensemble(const fs::path& folder) {
  const fs::path members = members_folder(folder);
  fs::path first;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(members, ignored)) {
    if (entry.path().extension() == ".h5" && (first.empty() || entry.path() < first)) first = entry.path();
  }
  std::string text = fmt::format("; its packings are in {}: choose one of those", members.string());
  if (!first.empty()) text += fmt::format(", for example {}", first.string());
  return text;
}

[[noreturn]] void refuse_folder(const fs::path& path) {
  if (is_there(path / "ensemble.toml") || is_there(path / "ensemble.h5"))
    throw InputError(
        fmt::format("{}: this is the folder of an ensemble{}", path.string(), advice_on_ensemble(path)));
  if (is_there(path / "disks.csv") || is_there(path / "contacts.csv"))
    throw InputError(fmt::format(
        "{0}: this is a CSV scene; make a packing of it first: indet import --format csv {0} -o PACKING.h5",
        path.string()));
  throw InputError(fmt::format("{}: is a folder, not the HDF5 file of a packing", path.string()));
}

/// Texts that other programs or people write, and that import reads.
void refuse_text(const fs::path& path) {
  if (beginning(path).starts_with("ITEM:"))
    throw InputError(
        fmt::format("{}: this is a LAMMPS dump; make a packing of it first: indet import --format "
                    "lammps --atoms FILE --contacts FILE --friction MU -o PACKING.h5",
                    path.string()));
  const std::string extension = path.extension().string();
  if (extension == ".csv" || extension == ".toml")
    throw InputError(
        fmt::format("{}: a CSV scene is a folder (disks.csv, contacts.csv, walls.csv, scene.toml); "
                    "make a packing of it first: indet import --format csv FOLDER -o PACKING.h5",
                    path.string()));
}

}  // namespace

Hdf5File open_packing_or_ensemble(const fs::path& path) {
  try {
    Hdf5File file = open_on_trial(path);
    if (kind_of(file) == FileKind::kVtk)
      throw InputError(fmt::format(
          "{}: holds contacts for readers of VTK, not a packing; give the file that it was exported from",
          path.string()));
    return file;
  } catch (const InputError&) {
    std::error_code ignored;
    if (fs::is_directory(path, ignored)) refuse_folder(path);
    if (fs::is_regular_file(path, ignored)) refuse_text(path);
    throw;
  }
}

Hdf5File open_packing(const fs::path& path) {
  Hdf5File file = open_packing_or_ensemble(path);
  if (kind_of(file) == FileKind::kEnsemble) {
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    throw InputError(
        fmt::format("{}: this is the file of an ensemble{}", path.string(), advice_on_ensemble(folder)));
  }
  return file;
}

}  // namespace indet::app
