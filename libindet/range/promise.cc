#include "libindet/range/promise.h"

#include <algorithm>
#include <cmath>

#include "libindet/base/tolerances.h"

namespace indet {

Eigen::VectorXd loads_at_contacts(const Packing& packing) {
  const double largest = packing.internal_force_unit();
  Eigen::VectorXd loads(packing.contact_count());
  for (int i = 0; i < packing.contact_count(); ++i) {
    double least = largest;
    const auto see = [&](double load) {
      if (load > 0) least = std::min(least, load);
    };
    const auto see_disk = [&](DiskId disk) {
      Vector3 load = packing.wrench(disk);
      load.z() /= packing[disk].radius;
      see(load.lpNorm<Eigen::Infinity>());
    };
    const Contact& contact = packing[ContactId(i)];
    see_disk(contact.a);
    if (packing.is_free_disk(contact.b)) see_disk(contact.b.disk_id());
    if (contact.b.is_wall()) {
      const Wall& wall = packing[contact.b.wall_id()];
      if (wall.is_loaded()) see(std::fmax(std::abs(wall.load_n), std::abs(wall.load_t)));
    }
    loads[i] = least;
  }
  return loads;
}

double promised_width(double value, double load) {
  return tolerance::kCertifiedWidth * std::max(std::abs(value), load);
}

}  // namespace indet
