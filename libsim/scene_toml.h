#pragma once

#include <filesystem>
#include <string>

#include "libsim/scene.h"

namespace indet::sim {

/// Reads a scene (TOML). Keys that are missing keep their values of `defaults`; unknown keys and wrong types
/// are refused.
///
///     disks = 95
///     radius = [0.7, 1.0]          # uniform between these
///     density = 1.0
///     friction = 0.3               # or { disk = 0.3, wall = 0.5 }
///     gravity = [0, -1]
///     force_unit = 2.0             # only needed without gravity
///     container = "box"            # box, floor, funnel, none
///     width = 11.0
///     height = 38.0
///     funnel_angle = 30            # degrees
///     columns = 5
///     jitter = 1.0
///     seed = 0
///     [[wall]]                     # more walls
///     name = "ramp"
///     point = [0, 5]
///     normal = [0.6, 0.8]          # into the domain; made a unit vector
///
/// Throws InputError that names the file, the line and the reason.
Scene read_scene(const std::filesystem::path& path, const Scene& defaults = {});

/// The same text form of a scene; read_scene of it gives the scene back.
std::string to_toml(const Scene& scene);

}  // namespace indet::sim
