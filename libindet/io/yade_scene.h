#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "libindet/base/constants.h"
#include "libindet/io/packing_builder.h"

namespace indet {

/// What a packing needs of a scene of YADE, in three dimensions and SI units, from either of its files.
struct YadeBody {
  std::int32_t id = 0;
  std::string shape;  ///< "Sphere", "Wall", "Box", or another
  Eigen::Vector3d position{0, 0, 0};
  double radius = 0, mass = 0, inertia = 0;  ///< of a sphere
  Eigen::Vector3d velocity{0, 0, 0}, angular_velocity{0, 0, 0};
  int axis = 0, sense = 0;           ///< of a wall: its normal, and to which side it acts (0: both)
  Eigen::Vector3d extents{0, 0, 0};  ///< of a box: half its sides
  bool turned = false;               ///< of a box: it is not along the axes
  int blocked = 0;                   ///< blockedDOFs: x y z X Y Z = 1 2 4 8 16 32
  int material = -1;
  Place place;
};

/// An interaction that is real: its bodies touch. The normal points from `first` to `second`, forces are
/// those on `second`.
struct YadeInteraction {
  std::int32_t first = 0, second = 0;
  Eigen::Vector3d normal{0, 0, 0}, normal_force{0, 0, 0}, shear_force{0, 0, 0};
  double overlap = kNaN;   ///< penetrationDepth; NaN: it follows from the positions
  double friction = kNaN;  ///< tan of the friction angle; NaN: not in the file
  Place place;
};

struct YadeScene {
  std::optional<Eigen::Vector3d> gravity;
  std::optional<Eigen::Matrix3d> cell;  ///< Its columns are the vectors; none: the scene is not periodic.
  std::vector<YadeBody> bodies;
  std::vector<YadeInteraction> interactions;
};

/// Reads `bodies.txt` and `interactions.txt` in a folder, as apps/exporters/yade_export.py writes them: one
/// line a body or interaction, columns named by the last comment line before the first. Throws InputError.
YadeScene read_yade_folder(const std::filesystem::path& folder);

/// Reads what `O.save` wrote: the XML of boost's serialization, packed by gzip or not. Throws InputError.
YadeScene read_yade_archive(const std::filesystem::path& file);

}  // namespace indet
