#pragma once

#include <cstdint>

#include "libindet/lp/feasible_set.h"
#include "libindet/lp/maximiser.h"
#include "libindet/range/objective_table.h"
#include "libindet/range/optimality_checker.h"

namespace indet {

/// Finds the canonical state of an objective: of the optimal face {x : x_k = 0 for all k with positive
/// reduced cost} the point of smallest weight·x, and among equals that of the smallest value of a fixed
/// generic functional (docs/decisions/canonical-states.md).
class CanonicalStates {
 public:
  /// All must outlive the object.
  CanonicalStates(const SlopeView& view, const OptimalityChecker& checker, const ObjectiveTable& table)
      : view_(view), checker_(checker), table_(table) {}

  /// True if the state is still to be found. Without a proof of optimality the optimal face is not known.
  static bool is_open(const ObjectiveProgress& known);

  /// Finds the state of an open objective, and whether it is alone on its face.
  TaskResult find(Maximiser& solver, std::int64_t objective) const;

 private:
  bool is_point(Maximiser& solver, const Vertex& vertex, const std::vector<int>& held,
                SolverWork& work) const;

  const SlopeView& view_;
  const OptimalityChecker& checker_;
  const ObjectiveTable& table_;
};

}  // namespace indet
