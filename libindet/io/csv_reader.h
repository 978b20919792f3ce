#pragma once

#include <filesystem>

#include "libindet/io/imported_packing.h"

namespace indet {

/// Reads a scene of up to four files in one folder (docs/importing.md):
///
///   disks.csv     id, x, y, radius, mass          [inertia, angle, vx, vy, omega, fx, fy, torque, fixed]
///   walls.csv     id, px, py, nx, ny              [name, load_n, load_t]      no file: no walls
///   contacts.csv  a, b                  [nx, ny, mu, R, T, gap, lever_a, lever_b,
///                                                  R_lo, R_hi, T_lo, T_hi, image_x, image_y]
///   scene.toml    gravity = [0, -1], force_unit, mu, cell, stress (scene_file.h)   no file: gravity (0, −1)
///
/// Columns in brackets are optional, and their fields may be empty: inertia is then m r²/2, the normal and
/// the gap follow from the positions, mu is that of scene.toml, R and T are unknown, levers are the radius,
/// forces have no bounds beside friction, the image of b in a periodic scene is the nearest, walls are fixed,
/// the rest is 0, the mass of a fixed disk too. Disks are named by any non-negative integers; b = −(w + 1) is
/// the wall with id w. Contacts between two bodies without equations are left out and counted, loads that
/// cancel taken out (cancelling_loads.h) with a warning. The result is validated; throws InputError that
/// names file, line and reason.
ImportedPacking read_csv_scene(const std::filesystem::path& folder);

}  // namespace indet
