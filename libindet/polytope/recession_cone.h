#pragma once

#include <Eigen/Core>
#include <memory>
#include <utility>
#include <vector>

#include "libindet/lp/feasible_set.h"
#include "libindet/lp/lp_solver.h"

namespace indet {

/// The recession cone {r ≥ 0, A r = 0} of a set {x ≥ 0, A x = b}, on edges beside which no ray loads any.
/// Where bodies are pressed together by few rays, as a row of disks between walls by one, this is far smaller
/// than the set: its dimension is that of the rays.
struct RecessionCone {
  std::vector<int> edges;   ///< of the set; ascending
  std::vector<int> loaded;  ///< those of the set that some ray loads, ascending; empty: not known
  SlopeView truncated;      ///< {r : Σr ≤ 1} of it: its inequalities are those of the edges, then the cut

  /// A functional of the set's edges, on those of the cone.
  std::vector<std::pair<int, double>> restricted(const std::vector<std::pair<int, double>>& on_edges) const;
  /// The ray of a point of the truncated cone, on all edges of the set.
  Eigen::VectorXd ray(const Eigen::VectorXd& point, int inequalities) const;
};

/// The cone of a set that is not bounded. Below kFewestForEquations dimensions (interior.h) it is on all
/// edges, and `guess` does not matter. From there on it is on those of `guess`, of maximal support as far as
/// is known, and on those that linear programs find to be loaded beside them, until no sum over the others
/// exceeds tolerance::kRay in the truncated cone.
std::shared_ptr<const RecessionCone> find_recession_cone(const SlopeView& view, const Eigen::VectorXd& guess,
                                                         const LpOptions& options);

}  // namespace indet
