#include "apps/ensemble/tables/protocol_distances.h"

#include <algorithm>
#include <cmath>

namespace indet {

using sim::Protocol;

ProtocolDistances::State ProtocolDistances::state_of(const Packing& packing) {
  const double mg = packing.force_unit();
  State state;
  // R and T do not change if a contact's bodies change places.
  for (const Contact& c : packing.contacts)
    state[std::minmax({c.a.value(), c.b.code()})] = {c.R / mg, c.T / mg};
  return state;
}

double ProtocolDistances::distance(const State& a, const State& b) {
  double squares = 0;
  for (const auto& [bodies, force] : a) {
    const auto other = b.find(bodies);
    squares += (other == b.end() ? force : Vector2(force - other->second)).squaredNorm();
  }
  for (const auto& [bodies, force] : b) {
    if (!a.contains(bodies)) squares += force.squaredNorm();
  }
  return std::sqrt(squares);
}

void ProtocolDistances::add(const Member& member, const Packing& packing, std::size_t run, FlatTable& runs) {
  if (member.protocol == Protocol::kFile || member.protocol == Protocol::kMd1) return;
  if (!packing.has_simulated_forces()) return;
  const State state = state_of(packing);
  std::map<Protocol, Row>& others = of_seed_[member.seed];
  for (const auto& [protocol, other] : others) {
    const double d = distance(state, other.state);
    if (protocol == Protocol::kCd1) runs.set("distance_cd1", run, d);
    if (protocol == Protocol::kCd2) runs.set("distance_cd2", run, d);
    if (member.protocol == Protocol::kCd1) runs.set("distance_cd1", other.run, d);
    if (member.protocol == Protocol::kCd2) runs.set("distance_cd2", other.run, d);
  }
  others[member.protocol] = {run, state};
}

}  // namespace indet
