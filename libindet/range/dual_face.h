#pragma once

#include <Eigen/Core>
#include <vector>

#include "libindet/lp/feasible_set.h"
#include "libindet/lp/vertex.h"

namespace indet {

/// The reduced costs that prove a vertex optimal for max g·z over {x(z) = offset + slope · z ≥ 0}: with S the
/// rows of slope that are tight at the vertex (x_k = 0), the polytope
///
///   Λ = {λ ≥ 0 : Sᵀ λ = −g}
///
/// A vertex that is not degenerate has d tight rows, and Λ one element. Bounded, since the set has an
/// interior.
struct DualFace {
  std::vector<int> tight;                 ///< inequalities, ascending
  std::vector<Eigen::VectorXd> vertices;  ///< of Λ: a number for each of `tight`
  bool is_whole = false;                  ///< these are all; else there are none here
  /// The vertex is the only one that is optimal: the rows with λ > 0 somewhere in Λ have rank d. Of the whole
  /// face only.
  bool has_one_state = false;
};

/// Finds the rows with λ > 0 somewhere in Λ, which do not depend on the vertex, and enumerates the vertices
/// of Λ on these, from one dual feasible basis to its neighbours, up to tolerance::kMostDualBases of them.
/// `multipliers`: λ of the basis of the vertex (Vertex::multipliers), in its order.
DualFace find_dual_face(const SlopeView& view, const Vertex& vertex, const Eigen::VectorXd& multipliers);

}  // namespace indet
