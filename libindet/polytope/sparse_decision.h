#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "libindet/equilibrium/equilibrium_problem.h"
#include "libindet/packing/packing.h"
#include "libindet/polytope/force_polytope.h"

namespace indet {

/// What the polytope F of a packing is, decided without any dense matrix: by sparse QR for the rank, and by
/// the self-dual interior point method for the rest (barrier/feasibility.h). For packings that are too large
/// for find_force_polytope.
///
/// The steps are the same: if part of the load is outside the range of the equations, F is empty; edges that
/// are closed in every state are removed and the problem is posed again, until F is empty or has full
/// dimension in what is left; then F is bounded, or has a ray.
struct SparseDecision {
  /// False where double precision cannot tell; then nothing else is meaningful but `problem`, the steps that
  /// were taken, and `rank_ambiguous`.
  bool decided = false;
  PolytopeStatus status = PolytopeStatus::kEmpty;
  EquilibriumProblem problem;         ///< with closed edges removed
  std::vector<int> independent_rows;  ///< of `problem`: the others follow from them; ascending
  bool rank_ambiguous = false;        ///< some rank lies within rounding
  int dim = -1;                       ///< dim F; −1 if empty

  /// How the statement is known. A proof holds for the exact problem, whatever rounding did.
  enum class Proof : std::uint8_t {
    kNone,      ///< it rests on the iteration
    kFloating,  ///< by bounds of all rounding errors
    kExact      ///< by rational arithmetic
  };
  Proof proof = Proof::kNone;

  /// A step in which edges were closed: a motion of the rows of the problem as it was then, largest entry 1,
  /// under which the load does no work, these edges open, and those that stay open rest: (Aᵀ motion)_k > 0, =
  /// 0.
  struct Step {
    std::vector<int> half_planes;  ///< EquilibriumProblem::half_plane of each edge
    std::vector<EquilibriumRow> rows;
    Eigen::VectorXd motion;
  };
  std::vector<Step> steps;

  Eigen::VectorXd interior;  ///< x > 0 of a state (edges of `problem`), if F is not empty
  /// If F is empty: a motion of the rows, largest entry 1, Aᵀ motion ≥ 0 and b·motion < 0: the load does work
  /// and no edge resists, but for rounding and closed edges.
  Eigen::VectorXd motion;
  /// The same as it is proven, where it is, on the rows of exact::ContactProblem. No edge at all resists it.
  std::vector<double> proven_motion;
  Eigen::VectorXd ray;  ///< if unbounded: x ≥ 0, A x = 0, Σx = 1, of maximal support
  /// If unbounded: what proves the ray by bounds of all rounding errors; nothing if these do not.
  std::shared_ptr<const UnboundedPolytope> unbounded;
  /// If bounded: y of the rows with Aᵀ y ≥ 1, so that (Aᵀ y)·x = b·y everywhere in F. Aᵀ y − 1 is
  /// ForcePolytope::bounding_multipliers.
  Eigen::VectorXd bounding;

  double margin = 0;   ///< how clear the least clear decision was (Feasibility::margin)
  int iterations = 0;  ///< of the interior point method, in all
};

/// What is told is proven where this costs little: where bounds of rounding errors do it, and by rational
/// arithmetic where a motion has up to `exact_rows` equations, a ray as many edges (0.3 s at 400, growing
/// with the cube). The rank needs little of it, and is proven for up to 100 000 equations (0.2 s at 4800, 0.6
/// s at 30 000). Precondition: find_defect(packing) is empty.
inline constexpr int kExactRows = 400;
SparseDecision decide_sparsely(const Packing& packing, int exact_rows = kExactRows);

}  // namespace indet
