#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "libindet/io/table.h"

namespace indet {

/// One frame of a LAMMPS text dump (`dump custom`, `dump local`).
struct DumpFrame {
  std::int64_t timestep = 0;
  /// Lower and upper bound of the box in x and y; the box is periodic there if the flag is set.
  std::array<double, 2> low{}, high{};
  std::array<bool, 2> periodic{};
  Table table;  ///< The columns are named as in the dump.
};

/// Reads the last frame of a dump, or that of `timestep`. Throws InputError if the file is no text dump, the
/// frame is not in it (the message says which ones are) or has fewer rows than it announces.
DumpFrame read_dump_frame(const std::filesystem::path& path, std::optional<std::int64_t> timestep);

}  // namespace indet
