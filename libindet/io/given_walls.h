#pragma once

#include <map>
#include <string>
#include <vector>

#include "libindet/io/plane.h"

namespace indet {

/// A plane that no file has: the wall lies at `position` along axis 0 or 1 of the packing.
struct GivenWall {
  int axis = 0;
  double position = 0;
  std::string text;  ///< "wx1=x:0"
};

/// Walls by their names.
using GivenWalls = std::map<std::string, GivenWall>;

/// "NAME=x:0" items; the letters are those of the axes of `plane`. Throws InputError if an item has another
/// form, or a wall is given twice.
GivenWalls parse_walls(const std::vector<std::string>& items, const Plane& plane);

}  // namespace indet
