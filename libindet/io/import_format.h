#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "libindet/io/import_settings.h"
#include "libindet/io/imported_packing.h"
#include "libindet/io/lammps_dump.h"

namespace indet {

/// What is to be read.
struct ImportRequest {
  std::filesystem::path input;     ///< A file or folder, of formats that are one.
  DumpFiles dumps;                 ///< Of formats that are two dumps.
  std::vector<std::string> walls;  ///< "NAME=x:POSITION", of formats that do not say where walls are.
  std::optional<double> time;      ///< Of the frame, in formats whose frames have a time.
  ImportSettings settings;
};

/// A format that packings of other programs have. A new one is a file with such a value, and a line in
/// import_formats().
struct ImportFormat {
  std::string name;   ///< of --format
  std::string input;  ///< what its input is: "the folder with disks.csv, …"; "" if it is two dumps
  /// Options of `indet import` that it takes, beside those that all formats take.
  std::vector<std::string> options;
  Levers documented;  ///< Where its documentation says that forces act.
  /// Why --friction is needed; "" if the files have the friction.
  std::string lacks_friction;
  std::function<std::vector<std::filesystem::path>(const ImportRequest&)> files;  ///< That are read.
  std::function<ImportedPacking(const ImportRequest&)> read;                      ///< Throws InputError.
};

/// All of them, in the order in which help shows them.
const std::vector<ImportFormat>& import_formats();

// One function a format.
ImportFormat csv_format();
ImportFormat lammps_format();
ImportFormat liggghts_format();
ImportFormat mercury_format();
ImportFormat yade_format();

}  // namespace indet
