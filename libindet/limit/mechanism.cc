#include "libindet/limit/mechanism.h"

#include <algorithm>
#include <cmath>

#include "libindet/base/tolerances.h"

namespace indet {

std::vector<ContactRates> contact_rates(const Packing& packing, const exact::BodyMotion& motion) {
  std::vector<ContactRates> rates;
  for (const Contact& contact : packing.contacts) {
    const auto velocity = [&](Body body) -> Vector2 {
      if (!body.is_wall()) return motion.disks.row(body.disk_id().value()).head<2>();
      if (motion.walls.rows() == 0) return Vector2::Zero();
      const Wall& wall = packing[body.wall_id()];
      const int w = body.wall_id().value();
      return motion.walls(w, 0) * wall.normal + motion.walls(w, 1) * wall.tangent();
    };
    // rω is stored.
    const auto spin = [&](DiskId disk, double lever) {
      return lever / packing[disk].radius * motion.disks(disk.value(), 2);
    };
    Vector2 apart = velocity(Body::disk(contact.a)) - velocity(contact.b);
    if (motion.cell.rows() == 2 && !contact.b.is_wall())
      apart -= motion.cell * (packing.branch(contact) / packing.cell_length());
    ContactRates rate{contact.normal.dot(apart),
                      contact.tangent().dot(apart) + spin(contact.a, packing.lever_a(contact))};
    if (!contact.b.is_wall()) rate.sliding += spin(contact.b.disk_id(), packing.lever_b(contact));
    rates.push_back(rate);
  }
  return rates;
}

std::vector<ContactMotion> contact_motions(const Packing& packing, const exact::BodyMotion& motion) {
  const std::vector<ContactRates> rates = contact_rates(packing, motion);
  std::vector<ContactMotion> motions;
  for (std::size_t i = 0; i < rates.size(); ++i) {
    const double mu = packing.contacts[i].mu;
    const double scale = tolerance::kRestingRate * std::max(1.0, mu);
    if (mu == 0) {
      motions.push_back(rates[i].opening > scale             ? ContactMotion::kOpens
                        : std::abs(rates[i].sliding) > scale ? ContactMotion::kSlides
                                                             : ContactMotion::kRests);
      continue;
    }
    const bool plus = rates[i].opening + mu * rates[i].sliding > scale;
    const bool minus = rates[i].opening - mu * rates[i].sliding > scale;
    motions.push_back(plus && minus   ? ContactMotion::kOpens
                      : plus || minus ? ContactMotion::kSlides
                                      : ContactMotion::kRests);
  }
  return motions;
}

double load_power(const Packing& packing, const Loads& loads, const exact::BodyMotion& motion) {
  double power = 0;
  for (int i = 0; i < packing.disk_count(); ++i) {
    Vector3 wrench = loads.wrench(packing, DiskId(i));
    wrench.z() /= packing[DiskId(i)].radius;  // rω is stored
    power += wrench.dot(motion.disks.row(i));
  }
  for (int w = 0; w < motion.walls.rows(); ++w) {
    for (const int k : {0, 1}) power += loads.on_wall(WallId(w), k) * motion.walls(w, k);
  }
  if (motion.cell.rows() == 2) {
    const auto& [xx, yy, xy, pressure] = loads.stress;
    const double along = xx * motion.cell(0, 0) + yy * motion.cell(1, 1) + xy * motion.cell(0, 1) +
                         pressure * motion.cell.trace();
    power += packing.cell.area() / packing.cell_length() * along;
  }
  return power;
}

std::vector<DiskId> moving_disks(const exact::BodyMotion& motion) {
  std::vector<DiskId> disks;
  for (Eigen::Index i = 0; i < motion.disks.rows(); ++i) {
    if (!motion.disks.row(i).isZero(0)) disks.emplace_back(static_cast<int>(i));
  }
  return disks;
}

}  // namespace indet
