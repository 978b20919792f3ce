#pragma once

#include <cstdint>
#include <span>

#include "libindet/lp/feasible_set.h"

namespace indet {

enum class LpStatus : std::uint8_t { kOptimal, kUnbounded, kInfeasible, kFailed };

/// The solver's proposal. Values are never taken from it: they are recomputed from the basis.
struct LpAnswer {
  LpStatus status = LpStatus::kFailed;
  Basis basis;              ///< d inequalities, if optimal
  std::int64_t solves = 1;  ///< linear programs posed: more than one where a formulation failed
  std::int64_t pivots = 0;  ///< of all of them
  int attempts = 0;         ///< ways that were tried
  bool continued = false;   ///< from the factors of the question before
};

/// Maximises linear objectives over one FeasibleSet, from given start vertices: what the search for all
/// extrema asks of a linear programming method.
class Maximiser {
 public:
  virtual ~Maximiser() = default;

  /// Maximises the objective, subject to x_k = 0 for k in `held`. `start`: a feasible vertex, at which x_k =
  /// 0 for k in `held`.
  virtual LpAnswer maximise(const Objective& objective, const Basis& start,
                            std::span<const int> held = {}) = 0;
};

}  // namespace indet
