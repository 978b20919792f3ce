#pragma once

#include <filesystem>

#include "libindet/io/simulation_file.h"
#include "libindet/packing/packing.h"

namespace indet {

/// Pictures of a trajectory as SVG: disks with a radius line that shows their orientation, walls, and contact
/// forces as lines of thickness ∝ R (all frames on one scale). `packing` gives radii, walls and the unit of
/// force.

/// `frames` states side by side, evenly spaced in the trajectory and with their times below.
/// Precondition: the trajectory is not empty, frames ≥ 1.
void draw_trajectory_strip(const std::filesystem::path& path, const Packing& packing,
                           const Trajectory& trajectory, int frames);

/// All frames one after the other, for `seconds` in a loop (SMIL; any browser shows it).
/// Precondition: the trajectory is not empty.
void draw_trajectory_animation(const std::filesystem::path& path, const Packing& packing,
                               const Trajectory& trajectory, double seconds);

}  // namespace indet
