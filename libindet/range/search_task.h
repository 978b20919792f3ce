#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "libindet/lp/maximiser.h"
#include "libindet/range/optimality_checker.h"
#include "libindet/range/paper_work.h"

namespace indet {

/// What the solvers had to do.
struct SolverWork {
  std::int64_t solves = 0;
  std::int64_t continued = 0;  ///< solves that began with the factors of the one before
  std::int64_t pivots = 0;

  void add(const LpAnswer& answer) {
    solves += answer.solves;
    continued += answer.continued ? 1 : 0;
    pivots += answer.pivots;
  }
  SolverWork& operator+=(const SolverWork& other) {
    solves += other.solves;
    continued += other.continued;
    pivots += other.pivots;
    return *this;
  }
};

/// What one task of the search (the value or the state of one objective) hands back to the calling thread.
struct TaskResult {
  std::int64_t objective = -1;
  LpStatus status = LpStatus::kFailed;
  SolverWork work;
  PaperWork paper;
  std::optional<CheckedVertex> found;      ///< the vertex that was reached
  std::vector<ObjectiveVerdict> verdicts;  ///< what that vertex proves
  bool settles_state = false;              ///< the vertex is the canonical state of `objective`
  bool unique = false;                     ///< … and alone on the optimal face
};

}  // namespace indet
