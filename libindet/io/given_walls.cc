#include "libindet/io/given_walls.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "libindet/base/error.h"
#include "libindet/base/printable.h"
#include "libindet/io/table.h"

namespace indet {

GivenWalls parse_walls(const std::vector<std::string>& items, const Plane& plane) {
  GivenWalls walls;
  for (const std::string& item : items) {
    const std::size_t equals = item.find('=');
    const std::size_t colon = item.find(':', equals == std::string::npos ? 0 : equals);
    GivenWall wall{.text = item};
    const bool has_form = equals != std::string::npos && equals > 0 && colon == equals + 2 &&
                          parse_number(std::string_view(item).substr(colon + 1), &wall.position) &&
                          std::isfinite(wall.position);
    const char letter = has_form ? item[equals + 1] : '\0';
    if (letter != Plane::letter(plane.first) && letter != Plane::letter(plane.second)) {
      throw InputError(fmt::format("wall \"{}\" must have the form NAME={}:POSITION or NAME={}:POSITION",
                                   excerpt(item), Plane::letter(plane.first), Plane::letter(plane.second)));
    }
    wall.axis = letter == Plane::letter(plane.first) ? 0 : 1;
    if (!walls.emplace(item.substr(0, equals), wall).second) {
      throw InputError(fmt::format("wall {} is given twice", excerpt(item.substr(0, equals))));
    }
  }
  return walls;
}

}  // namespace indet
