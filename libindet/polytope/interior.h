#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "libindet/lp/feasible_set.h"
#include "libindet/lp/lp_solver.h"

namespace indet {

/// Dimensions from which the sparse equations are the faster form of a single linear program
/// (docs/decisions/range-search.md).
inline constexpr int kFewestForEquations = 100;

/// The formulation for one linear program, or few: the dual one, and the sparse equations where they are
/// given and the dimension is large.
Formulation choose_formulation_of_one(const SlopeView& view);

/// Maximises by that formulation, and where that fails by the explicit one.
LpAnswer maximise_robustly(const SlopeView& view, const Objective& objective, const Basis& start,
                           const LpOptions& options);

/// The result of "maximise t ≤ 1 with every x ≥ t" over a FeasibleSet.
struct InteriorPoint {
  double slack = 0;  ///< t: > 0 strictly interior point, < 0 the set is empty, 0: see `multipliers`
  Eigen::VectorXd z;
  /// y ≥ 0, Σy = 1, slopeᵀ y = 0: y·x is the same number t everywhere. t < 0 proves emptiness (Farkas); t = 0
  /// proves that every x_k with y_k > 0 is 0 everywhere. Zero if t reached its cap.
  Eigen::VectorXd multipliers;
  double infeasibility = 0;  ///< by how much the recomputed point misses its own inequalities x ≥ t
  std::int64_t pivots = 0;
};

/// Throws LibraryError if the linear program fails.
InteriorPoint find_interior_point(const SlopeView& view, const LpOptions& options);

/// The recession cone of a set, cut off: {z : slope · z ≥ 0, Σ slope · z ≤ 1}. Its inequalities are those of
/// the set, then the cut. Where `view` is large and has a FeasibleSet, so has it.
SlopeView truncated_recession_cone(const SlopeView& view);

/// A direction in which a set is unbounded.
struct RecessionRay {
  Eigen::VectorXd x;  ///< x ≥ 0, Σx = 1; empty if the set is bounded
  double infeasibility =
      0;  ///< max(0, −min x) as recomputed: positive where the set is unbounded but for a hair
  /// λ ≥ 0 with (1 + λ)ᵀ slope = 0, where the set is bounded: then (1 + λ)·x is the same number everywhere in
  /// it, and no smaller than Σx. Empty otherwise.
  Eigen::VectorXd multipliers;
  double noise = 0;  ///< what rounding alone can make of the infeasibility, from the condition of the vertex
  std::int64_t pivots = 0;
};

/// Maximises Σx over the truncated recession cone. Throws LibraryError if the linear program fails.
RecessionRay find_recession_ray(const SlopeView& view, const LpOptions& options);

}  // namespace indet
