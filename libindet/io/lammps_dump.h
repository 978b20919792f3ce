#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "libindet/io/plane.h"
#include "libindet/io/table.h"
#include "libindet/packing/cell.h"

namespace indet {

/// One frame of a LAMMPS or LIGGGHTS text dump (`dump custom`, `dump local`).
struct DumpFrame {
  std::int64_t timestep = 0;
  /// Lower and upper bound of the box along x, y, z, of a tilted box those of all its points; the box is
  /// periodic there if the flag is set.
  std::array<double, 3> low{}, high{};
  std::array<bool, 3> periodic{};
  bool tilted = false;                           ///< The box is a parallelepiped.
  std::array<std::array<double, 3>, 3> edges{};  ///< The edge vectors of the box.
  Table table;                                   ///< The columns are named as in the dump.
};

/// Reads the last frame of a dump, or that of `timestep`. The header of a frame is
///
///   [ITEM: UNITS …] [ITEM: TIME …] ITEM: TIMESTEP … ITEM: NUMBER OF … ITEM: BOX BOUNDS … ITEM: ATOMS columns
///
/// with the box as "lo hi" (with a tilt as third number in triclinic boxes), or, of a general triclinic one
/// ("BOX BOUNDS abc origin"), a row for each edge vector with a component of the origin as fourth number.
/// Throws InputError if the file is no text dump, the frame is not in it (the message says which ones are) or
/// has fewer rows than it announces.
DumpFrame read_dump_frame(const std::filesystem::path& path, std::optional<std::int64_t> timestep);

/// Which frame of which dumps makes a packing.
struct DumpFiles {
  std::filesystem::path atoms{};           ///< `dump custom`
  std::filesystem::path contacts{};        ///< `dump local`
  std::optional<std::int64_t> timestep{};  ///< None: the last frame of each.
};

/// Atoms and contacts of one timestep.
struct DumpPair {
  DumpFrame atoms, contacts;
  bool is_periodic(const Plane& plane) const;  ///< Along an axis of the plane.
  /// The edges of the box in the plane along which it is periodic. Throws InputError if one leaves the plane.
  Cell cell(const Plane& plane) const;
};

/// Throws InputError like read_dump_frame, or if the frames are of different timesteps.
DumpPair read_dumps(const DumpFiles& files);

}  // namespace indet
