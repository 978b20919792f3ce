#pragma once

#include <Eigen/Core>
#include <memory>
#include <utility>
#include <vector>

#include "libindet/base/sparse_lu.h"
#include "libindet/lp/feasible_set.h"

namespace indet {

/// What a Vertex reads from S_N⁻¹, by a sparse factor of the set's equations E x = b instead. N are the d
/// active inequalities, B the others, and E_B is square:
///
///   the vertex        x_N = 0,    x_B = E_B⁻¹ b
///   edge k leaves it  x_N = 1_k,  x_B = −E_B⁻¹ E_N 1_k
///   reduced costs     λ = E_Nᵀ E_B⁻ᵀ e_B − e_N   of e · x
class SparseBasis {
 public:
  /// Nothing if the active inequalities are not independent, as far as the factor tells.
  static std::shared_ptr<const SparseBasis> factorise(std::shared_ptr<const FeasibleSet> set,
                                                      const Basis& basis);

  Eigen::VectorXd point() const;      ///< K; one step of refinement
  Eigen::VectorXd edge(int k) const;  ///< K
  /// The direction in which the active inequalities grow so fast: x_N = rates, x_B = −E_B⁻¹ E_N rates. K
  Eigen::VectorXd direction(const Eigen::VectorXd& rates) const;
  Eigen::VectorXd multipliers(const std::vector<std::pair<int, double>>& on_edges) const;  ///< d

 private:
  SparseBasis(std::shared_ptr<const FeasibleSet> set, const Basis& basis);
  Eigen::VectorXd on_edges(const Eigen::VectorXd& basic) const;

  std::shared_ptr<const FeasibleSet> set_;
  Basis active_;
  std::vector<int> basic_;  ///< the other inequalities, ascending
  std::vector<int> place_;  ///< of each inequality in basic_, −1 if it is active
  SparseLu lu_;
};

}  // namespace indet
