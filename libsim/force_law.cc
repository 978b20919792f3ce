#include "libsim/force_law.h"

#include <cmath>

namespace indet::sim {

std::vector<ContactState> elastic_forces(const World& world, const std::vector<ContactState>& contacts,
                                         double k) {
  std::vector<ContactState> result;
  result.reserve(contacts.size());
  for (ContactState contact : contacts) {
    const int a = contact.a;
    if (contact.b < 0) {
      const Wall& wall = world.walls[-contact.b - 1];
      contact.nx = wall.normal.x();
      contact.ny = wall.normal.y();
      contact.gap = (world.x[a] - wall.point.x()) * contact.nx + (world.y[a] - wall.point.y()) * contact.ny -
                    world.radius[a];
    } else {
      const double dx = world.x[a] - world.x[contact.b];
      const double dy = world.y[a] - world.y[contact.b];
      const double distance = std::sqrt(dx * dx + dy * dy);
      contact.nx = dx / distance;
      contact.ny = dy / distance;
      contact.gap = distance - (world.radius[a] + world.radius[contact.b]);
    }
    if (!(contact.gap < 0)) continue;
    contact.R = -k * contact.gap;
    contact.T = std::clamp(-k * contact.spring, -contact.mu * contact.R, contact.mu * contact.R);
    result.push_back(contact);
  }
  return result;
}

}  // namespace indet::sim
