#pragma once

#include <cstdint>
#include <vector>

#include "libindet/packing/packing.h"

namespace indet {

/// The contacts of a packing as the cells of an unstructured grid of VTK, so that a number of each contact is
/// a number of each cell. P = N + (contacts with a wall, or with an image across the boundary of a periodic
/// cell).
///
/// - points: the centres of the disks, then the foot of each contact with a wall, in the order of contacts:
///   the point of the wall that is nearest to the centre of a; and the centre of each image that a contact is
///   with; z = 0;
/// - cells: the M contacts, each a line from the centre of a to that of b, to that of its image, or to its
/// foot.
struct VtkGrid {
  std::vector<double> points;              ///< [P, 3]
  std::vector<std::int64_t> connectivity;  ///< [2M]: the points of cell α are 2α and 2α + 1 here.
  std::vector<std::int64_t> offsets;       ///< [M + 1]: 0, 2, …, 2M
  std::vector<std::uint8_t> types;         ///< [M]: all VTK_LINE
  std::vector<double> radius;              ///< [P]; 0 of a foot or an image
  std::vector<std::int32_t> body;   ///< [P]: row of the disk (also of an image), or −(w + 1) of the wall
  std::vector<std::uint8_t> fixed;  ///< [P]: 1 of a fixed disk

  static constexpr std::uint8_t kLine = 3;  ///< VTK_LINE
  std::size_t point_count() const { return body.size(); }
};

VtkGrid vtk_grid(const Packing& packing);

}  // namespace indet
