#pragma once

#include <cstdint>
#include <map>
#include <utility>

#include "apps/ensemble/members/plan.h"
#include "apps/ensemble/tables/flat_table.h"
#include "libindet/packing/packing.h"

namespace indet {

/// Distances between the simulated states of one seed: the columns distance_cd1 and distance_cd2 of
/// /table/runs. A contact is the same in two states if it joins the same bodies; one that a state lacks has
/// forces 0 there. MD-1 has other positions, and no distance.
class ProtocolDistances {
 public:
  /// Remembers the state of a packing, which is that of row `run`, and fills in its distances to those that
  /// came before it, in their rows too. In any order.
  void add(const Member& member, const Packing& packing, std::size_t run, FlatTable& runs);

 private:
  using State = std::map<std::pair<int, int>, Vector2>;  ///< (R, T) in mg by bodies.
  struct Row {
    std::size_t run;
    State state;
  };
  static State state_of(const Packing& packing);
  static double distance(const State& a, const State& b);

  std::map<std::int64_t, std::map<sim::Protocol, Row>> of_seed_;
};

}  // namespace indet
