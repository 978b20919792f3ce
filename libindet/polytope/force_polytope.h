#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "libindet/barrier/independent_parts.h"
#include "libindet/equilibrium/equilibrium_problem.h"
#include "libindet/exact/contact_problem.h"
#include "libindet/lp/feasible_set.h"
#include "libindet/lp/lp_solver.h"
#include "libindet/nullspace/null_space.h"
#include "libindet/packing/packing.h"

namespace indet {

struct CentralPolytope;
struct RecessionCone;
struct UnboundedPolytope;

/// What the polytope of admissible contact states F [19] of a packing is.
enum class PolytopeStatus : std::uint8_t {
  kBounded,    ///< More than one state, all forces limited.
  kUnbounded,  ///< Some force can grow without limit; `ray` shows how.
  kPoint,      ///< One state: no indeterminacy.
  kEmpty       ///< No state: the packing cannot stand; `motion` shows which disks move.
};
const char* to_string(PolytopeStatus status);

/// An independent part of F: the strengths x of some contacts' edges, coupled to each other and to no others.
/// F is the product of its blocks and of the edges that are determined.
struct PolytopeBlock {
  SlopeView view;          ///< of `set`, which is full-dimensional
  std::vector<int> edges;  ///< local index of x → index into ForcePolytope::problem.edges; ascending
  Basis lightest;          ///< the vertex of smallest total normal force
  std::shared_ptr<const RecessionCone> recession;  ///< null where the block is bounded

  const FeasibleSet& set() const { return *view.set; }
};

/// The polytope F = {F1 + Z z ∈ K} [19] of a packing, in dimensionless form.
///
/// Found in three steps. (1) Linear algebra: if some part of the load is outside the range of c, no contact
/// force balances it. (2) The linear program "maximise t with every x ≥ t" gives a strictly interior point (t
/// > 0), a Farkas certificate that F is empty (t < 0), or multipliers that name edges which are closed
/// everywhere in F (t = 0): contacts that must slide or transmit nothing. Those edges are removed and the
/// problem is posed again, until F has full dimension in what is left. (3) F is bounded if Σx is.
struct ForcePolytope {
  PolytopeStatus status = PolytopeStatus::kEmpty;
  EquilibriumProblem natural;  ///< the problem with every contact as the scene has it
  EquilibriumProblem problem;  ///< the problem with closed edges removed
  /// Of both; the same where no edge is closed. Without kernel and particular solution, and of a problem
  /// with closed edges none, where the polytope was
  /// found by the barrier method.
  std::shared_ptr<const NullSpace> natural_null_space, null_space;
  /// The problem over the rational numbers, with every contact as the scene has it; where it was needed.
  std::shared_ptr<const exact::ContactProblem> exact;
  /// The analytic centre, where it was asked for (central_polytope.h).
  std::shared_ptr<const CentralPolytope> central;
  /// What stands in its place where F is unbounded and the barrier method can tell (unbounded_polytope.h).
  std::shared_ptr<const UnboundedPolytope> unbounded;
  int dim = -1;                 ///< dim F; −1 if empty
  bool rank_ambiguous = false;  ///< of either null space
  /// Some decision (rank, emptiness, dimension, boundedness) lies within rounding: results may be wrong by
  /// order one.
  bool doubtful = false;
  /// Then: relative size of a change of the packing's numbers that may alter it, estimated; NaN otherwise.
  double hairline = std::numeric_limits<double>::quiet_NaN();
  double interior_slack = 0;  ///< t of the interior point (mg): every x is at least this; capped at 1
  Eigen::VectorXd interior;   ///< x of that point (all edges of `problem`)
  Eigen::VectorXd lightest;   ///< x of the state of smallest total normal force (all edges of `problem`)
  std::vector<PolytopeBlock> blocks;  ///< none where the polytope was found by the barrier method
  barrier::IndependentParts parts;    ///< in their place, then
  Eigen::VectorXd ray;  ///< x-direction of unbounded growth (edges of `problem`); empty if bounded
  /// If bounded or a point: λ ≥ 0 such that (1 + λ)·x is the same number everywhere in F, which bounds Σx.
  Eigen::VectorXd bounding_multipliers;
  /// If empty: virtual velocity (x, y, rω) of each disk under which the load does positive work while no
  /// contact resists [N, 3], largest entry 1.
  Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> motion;
  /// The same of walls, if some are loaded: along the normal and the tangent [W, 2].
  Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor> wall_motion;
  /// If stress is imposed, the rate of compression e_ij of the cell, times Packing::cell_length [2, 2]: what
  /// lies at x moves with −e x beside its own velocity. It has no yx.
  Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor> cell_motion;
  /// The multipliers of bounds that go with it (of force_bounds(), in its order): with v_k = motion · A_k the
  /// power of a force F_k along the motion and m the multipliers, v_k + Σ m over its bounds must not be
  /// negative along any edge, m ≥ 0 of a kUpper, m ≤ 0 of a kLower, and power of the load − Σ m · value > 0.
  Eigen::VectorXd bound_multipliers;
  std::int64_t pivots = 0;
  std::int64_t solves = 0;
};

/// Precondition: find_defect(packing) is empty. Throws LibraryError if a linear program cannot be solved by
/// any rung of the ladder.
ForcePolytope find_force_polytope(const Packing& packing, const LpOptions& options = {});

}  // namespace indet
