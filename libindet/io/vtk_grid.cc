#include "libindet/io/vtk_grid.h"

namespace indet {

VtkGrid vtk_grid(const Packing& packing) {
  VtkGrid grid;
  const auto add_point = [&](const Vector2& position, double radius, std::int32_t body) {
    grid.points.insert(grid.points.end(), {position.x(), position.y(), 0});
    grid.radius.push_back(radius);
    grid.body.push_back(body);
    grid.fixed.push_back(body >= 0 && packing[DiskId(body)].fixed ? 1 : 0);
    return static_cast<std::int64_t>(grid.body.size()) - 1;
  };
  for (int i = 0; i < packing.disk_count(); ++i) {
    add_point(packing[DiskId(i)].position, packing[DiskId(i)].radius, i);
  }
  grid.offsets.push_back(0);
  for (const Contact& contact : packing.contacts) {
    std::int64_t end = contact.b.code();
    if (contact.b.is_wall()) {
      const Wall& wall = packing[contact.b.wall_id()];
      const Vector2& centre = packing[contact.a].position;
      end = add_point(centre - (centre - wall.point).dot(wall.normal) * wall.normal, 0, contact.b.code());
    }
    if (contact.has_image())
      end = add_point(packing[contact.a].position - packing.branch(contact), 0, contact.b.code());
    grid.connectivity.insert(grid.connectivity.end(), {contact.a.value(), end});
    grid.offsets.push_back(static_cast<std::int64_t>(grid.connectivity.size()));
    grid.types.push_back(VtkGrid::kLine);
  }
  return grid;
}

}  // namespace indet
