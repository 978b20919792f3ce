#include "libindet/verify/needed_equations.h"

#include <cmath>
#include <vector>

#include "libindet/packing/force_bounds.h"

namespace indet {

std::int64_t needed_equations(const Packing& packing) {
  std::vector<bool> is_touched(packing.disks.size(), false);
  std::vector<bool> is_turned(packing.disks.size(), false);
  for (const Contact& contact : packing.contacts) {
    const auto touch = [&](DiskId disk) {
      if (packing[disk].fixed) return;
      const auto i = static_cast<std::size_t>(disk.value());
      is_touched[i] = true;
      is_turned[i] = is_turned[i] || contact.mu > 0;
    };
    touch(contact.a);
    if (!contact.b.is_wall()) touch(contact.b.disk_id());
  }
  auto count = static_cast<std::int64_t>(force_bounds(packing).size());
  for (const double stress : packing.stress.components())
    count += !std::isnan(stress) && (!packing.contacts.empty() || stress != 0) ? 1 : 0;
  for (int w = 0; w < packing.wall_count(); ++w) {
    const Wall& wall = packing[WallId(w)];
    bool touched = false;
    bool rubbed = false;
    for (const Contact& contact : packing.contacts) {
      if (contact.b != Body::wall(WallId(w))) continue;
      touched = true;
      rubbed = rubbed || contact.mu > 0;
    }
    count += !std::isnan(wall.load_n) && (touched || wall.load_n != 0) ? 1 : 0;
    count += !std::isnan(wall.load_t) && (rubbed || wall.load_t != 0) ? 1 : 0;
  }
  for (std::size_t i = 0; i < packing.disks.size(); ++i) {
    const Vector3 load = packing.wrench(DiskId(static_cast<int>(i)));
    for (int k = 0; k < 3; ++k) count += (k < 2 ? is_touched[i] : is_turned[i]) || load[k] != 0 ? 1 : 0;
  }
  return count;
}

}  // namespace indet
