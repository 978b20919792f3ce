#include "libsim/contact_memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "libindet/base/error.h"

namespace indet::sim {
namespace {

/// A contact as the simulators have it: of two disks, a < b. With both bodies n̂ and t̂ change their sign, so
/// that R and T stay.
ContactState ordered(const Contact& contact) {
  int a = contact.a.value();
  int b = contact.b.code();
  const bool swaps = b >= 0 && b < a;
  const double sign = swaps ? -1 : 1;
  if (swaps) std::swap(a, b);
  return {.a = a,
          .b = b,
          .nx = sign * contact.normal.x(),
          .ny = sign * contact.normal.y(),
          .gap = contact.gap,
          .mu = contact.mu,
          .R = contact.R,
          .T = contact.T};
}

}  // namespace

std::vector<ContactState> contact_memory(const Packing& packing, const Units& units,
                                         const SimulationOptions& options) {
  const bool rigid = options.simulator == Simulator::kContactDynamics;
  const double k = options.molecular_dynamics.k * units.stiffness();
  std::vector<ContactState> memory;
  for (const Contact& contact : packing.contacts) {
    ContactState state = ordered(contact);
    if (!std::isfinite(state.R) || !std::isfinite(state.T)) {
      throw InputError(fmt::format(
          "the forces of contact {} are not known, from which a run could go on; let the packing come to "
          "rest first (simulate --from with cd2 or md2)",
          &contact - packing.contacts.data()));
    }
    if (!rigid) {
      state.spring = -state.T / k;
      // Springs that do not touch remember nothing.
      if (!(geometric_gap(packing, contact.a, contact.b) < 0)) continue;
    }
    memory.push_back(state);
  }
  // The order of the steppers: by a, walls before disks.
  const auto rank = [](const ContactState& c) { return std::tuple(c.a, c.b >= 0, c.b >= 0 ? c.b : -c.b); };
  std::sort(memory.begin(), memory.end(),
            [&](const ContactState& p, const ContactState& q) { return rank(p) < rank(q); });
  return memory;
}

double force_distance(const Packing& first, const std::vector<ContactState>& second) {
  std::map<std::pair<int, int>, Vector2> change;
  for (const Contact& contact : first.contacts) {
    const ContactState state = ordered(contact);
    change[{state.a, state.b}] = {-state.R, -state.T};
  }
  for (const ContactState& state : second) {
    const auto place = change.try_emplace({state.a, state.b}, Vector2{0, 0}).first;
    place->second += Vector2{state.R, state.T};
  }
  double square = 0;
  for (const auto& [bodies, difference] : change) square += difference.squaredNorm();
  return std::sqrt(square) / first.force_unit();
}

}  // namespace indet::sim
