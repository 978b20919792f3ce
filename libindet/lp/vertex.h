#pragma once

#include <Eigen/Core>

#include "libindet/dense/lu.h"
#include "libindet/lp/feasible_set.h"

namespace indet {

/// A vertex recomputed from its basis alone, in our own arithmetic: z = −S_N⁻¹ o_N with one step of iterative
/// refinement, where S_N and o_N are the d active rows of slope and offset. Whatever a solver claims, this is
/// what is stored.
struct Vertex {
  Basis basis;
  Eigen::VectorXd z;                            ///< d
  Eigen::VectorXd x;                            ///< K; exactly 0 at the active inequalities
  Eigen::PartialPivLU<Eigen::MatrixXd> active;  ///< factors of S_N, d × d

  /// Column k of S_N⁻¹: the direction of the polytope's edge along which active inequality k is left.
  Eigen::VectorXd edge_direction(int k) const;

  /// Largest violation of an inequality: max(0, −min x).
  double infeasibility() const;

  /// Reduced costs of maximising g·z: λ = −S_N⁻ᵀ g. The vertex is optimal if λ ≥ 0; λ_k is the loss per unit
  /// of leaving inequality k.
  Eigen::VectorXd multipliers(const Eigen::Ref<const Eigen::VectorXd>& g) const;
};

/// Throws LibraryError if the active rows are not independent. Preconditions: basis.size() = d.
Vertex compute_vertex(const SlopeView& view, const Basis& basis);

/// How far one can go from the vertex along the polytope's edge k (the direction edge_direction(k)) before
/// another inequality stops it; +inf if nothing does. Inequalities in `basis` other than k hold along it.
double polytope_edge_length(const SlopeView& view, const Vertex& vertex, int k);

}  // namespace indet
