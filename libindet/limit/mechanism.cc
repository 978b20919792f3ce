#include "libindet/limit/mechanism.h"

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

std::vector<DiskId> moving_disks(const exact::BodyMotion& motion) {
  std::vector<DiskId> disks;
  for (Eigen::Index i = 0; i < motion.disks.rows(); ++i) {
    if (!motion.disks.row(i).isZero(0)) disks.emplace_back(static_cast<int>(i));
  }
  return disks;
}

}  // namespace indet
