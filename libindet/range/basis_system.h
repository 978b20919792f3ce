#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <utility>
#include <vector>

#include "libindet/base/sparse_lu.h"
#include "libindet/lp/vertex.h"
#include "libindet/polytope/force_polytope.h"
#include "libindet/range/doubled_equations.h"

namespace indet {

/// The square system of the lightest vertex of every block: N₀ are the edges that are 0 there, B₀ the others,
/// and A_B₀, on the independent equations, is factorised once.
class LightestSystem {
 public:
  LightestSystem(const ForcePolytope& polytope, const DoubledEquations& equations);

  /// A_B₀ is square, and not singular. What the other members return is 0 where not.
  bool is_regular() const { return is_regular_; }

  /// x with x = 0 on N₀ and A x = r, but for rounding; r has all equations, x all edges.
  Eigen::VectorXd solution(const Eigen::VectorXd& r) const;
  /// y with Aᵀ y = c but for rounding, for c in the row space of A; and 0 in equations that are not needed.
  Eigen::VectorXd motion(const Eigen::VectorXd& c) const;

 private:
  Eigen::Index equations_ = 0, edges_ = 0;
  std::vector<int> rows_;   ///< independent
  std::vector<int> basic_;  ///< B₀
  SparseLu lu_;
  bool is_regular_ = false;
};

/// The square system of a state that has some blocks at a vertex, and the others at their lightest one: N are
/// the edges that are 0 there, B the others.
///
///   the state            x_N = 0,   A_B x_B = b
///   multipliers of g·x   A_Bᵀ y = g_B,   with the reduced costs −(g − Aᵀ y)_N
///
/// Factors of a vertex lead from a solution of the lightest system to one of this. Iterative refinement, with
/// residuals and solutions in twice the precision, leaves about 1e-30 times the condition of A_B of both;
/// nothing here is proven.
class BasisSystem {
 public:
  using Vertices = std::vector<std::pair<std::size_t, const Vertex*>>;

  /// `vertices`: blocks with theirs, which have their factors. All must outlive this.
  BasisSystem(const ForcePolytope& polytope, const DoubledEquations& equations,
              const LightestSystem& lightest, Vertices vertices);

  /// N, one an edge.
  const std::vector<bool>& active() const { return active_; }

  struct Solution {
    std::vector<Doubled> value;
    Bounded residual;
  };
  /// x, and b − A x.
  Solution state() const;
  /// y, one an equation, and g − Aᵀ y.
  Solution multipliers(const DoubledFunctional& g) const;

 private:
  Eigen::VectorXd solution(const Eigen::VectorXd& r) const;
  Eigen::VectorXd motion(Eigen::VectorXd c) const;

  const ForcePolytope& polytope_;
  const DoubledEquations& equations_;
  const LightestSystem& lightest_;
  Vertices vertices_;
  std::vector<bool> active_;
};

}  // namespace indet
