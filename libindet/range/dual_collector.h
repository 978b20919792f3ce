#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "libindet/packing/packing.h"
#include "libindet/polytope/force_polytope.h"
#include "libindet/range/duals.h"

namespace indet {

/// Collects the Duals of values for a polytope that has an analytic centre.
///
/// A search knows the edges that are open. Those that are closed in every state need no bound X if a multiple
/// of the motion that closes them (SparseDecision::steps) is taken from y: the load does no work along it,
/// and it makes h_k ≥ 0 there.
class DualCollector {
 public:
  /// All must outlive this. Precondition: polytope.central.
  DualCollector(const Packing& packing, const ForcePolytope& polytope, const std::vector<int>& contacts);

  /// x, y: a point and multipliers for the least value of sign · (that force), on the open edges and on the
  /// rows of polytope.central. Without any, where the force is 0 in every state.
  void add(int contact, int column, std::vector<double> x, const std::vector<double>& y);
  /// None, where double precision does not tell which motion closes the edges.
  Duals take();

 private:
  int scene_row(const EquilibriumRow& row) const;
  Eigen::VectorXd on_natural_rows(std::span<const EquilibriumRow> rows, const Eigen::VectorXd& y) const;
  /// Of multipliers in the order of the centre's structure; none: 0.
  Eigen::VectorXd natural_motion(const std::vector<double>& y) const;
  Eigen::VectorXd on_scene_rows(const Eigen::VectorXd& natural) const;
  void find_closing();
  Eigen::VectorXd powers(const Eigen::VectorXd& natural) const;

  const Packing& packing_;
  const ForcePolytope& polytope_;
  Duals duals_;
  std::vector<int> first_;             ///< of the natural problem: first_unknowns
  std::vector<int> natural_of_scene_;  ///< −1: the scene does not need the row
  std::vector<int> closed_;            ///< columns of the natural problem
  Eigen::VectorXd closing_;            ///< a motion of its rows, 0 along open edges, > 0 along closed ones
  Eigen::VectorXd closing_powers_;     ///< Aᵀ closing
  bool is_known_ = true;
};

}  // namespace indet
