#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "libindet/io/table.h"

namespace indet {

/// The two files that MercuryDPM writes while a simulation runs.
struct MercuryFiles {
  std::filesystem::path data;   ///< NAME.data: particles
  std::filesystem::path fstat;  ///< NAME.fstat: contacts
  /// Both, from the name of either, also with a number or an ending behind it (NAME.data.0017,
  /// NAME.fstat.gz). None if the name is that of another file.
  static std::optional<MercuryFiles> of(const std::filesystem::path& file);
};

/// What they hold of one time.
struct MercuryFrame {
  double time = 0;
  /// Columns x y vx vy radius angle omega info (of two dimensions), or x y z vx vy vz radius angle_x angle_y
  /// angle_z omega_x omega_y omega_z info.
  Table particles;
  /// Columns time i j cx cy cz overlap slip normal_force tangential_force nx ny nz tx ty tz.
  Table contacts;
  std::vector<std::string> warnings;
};

/// Reads the frame of `time`, or the last one that both files have. A frame is
///
///   NAME.data    a line N t xmin ymin xmax ymax (of three dimensions: xmin ymin zmin xmax ymax zmax), then N
///                lines of 8 (14) columns
///   NAME.fstat   three lines that begin with #, of which the first has t, then lines of 16 columns
///
/// Throws InputError that names file, line and reason; also if no frame of both files has the same time.
MercuryFrame read_mercury_frame(const MercuryFiles& files, std::optional<double> time);

}  // namespace indet
