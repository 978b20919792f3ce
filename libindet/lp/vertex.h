#pragma once

#include <Eigen/Core>
#include <memory>

#include "libindet/dense/lu.h"
#include "libindet/lp/feasible_set.h"
#include "libindet/lp/sparse_basis.h"

namespace indet {

/// A vertex recomputed from its basis alone, in our own arithmetic: z = −S_N⁻¹ o_N with one step of iterative
/// refinement, where S_N and o_N are the d active rows of slope and offset. Whatever a solver claims, this is
/// what is stored.
struct Vertex {
  Basis basis;
  Eigen::VectorXd z;                            ///< d; empty where the factor is sparse
  Eigen::VectorXd x;                            ///< K; exactly 0 at the active inequalities
  Eigen::PartialPivLU<Eigen::MatrixXd> active;  ///< factors of S_N, d × d; or, instead,
  std::shared_ptr<const SparseBasis> sparse;    ///< that of the equations of its other inequalities

  /// Column k of S_N⁻¹: the direction of the polytope's edge along which active inequality k is left.
  /// Precondition: the factor is dense.
  Eigen::VectorXd edge_direction(int k) const;
  /// How fast the inequalities grow along it, S S_N⁻¹ 1_k. [K]
  Eigen::VectorXd edge_rates(const SlopeView& view, int k) const;

  /// The direction in which the active inequalities grow so fast, S S_N⁻¹ rates. [K]
  Eigen::VectorXd direction(const SlopeView& view, const Eigen::VectorXd& rates) const;

  /// The vertex without its factors.
  void drop_factors();

  /// Largest violation of an inequality: max(0, −min x).
  double infeasibility() const;

  /// Reduced costs of maximising g·z: λ = −S_N⁻ᵀ g. The vertex is optimal if λ ≥ 0; λ_k is the loss per unit
  /// of leaving inequality k.
  Eigen::VectorXd multipliers(const Objective& objective) const;
  /// The same of e·x, one coefficient an inequality.
  Eigen::VectorXd multipliers(const SlopeView& view, const Eigen::VectorXd& e) const;
};

/// Throws LibraryError if the active rows are not independent. Preconditions: basis.size() = d.
Vertex compute_vertex(const SlopeView& view, const Basis& basis);

/// The same, with a sparse factor where the view has a set and the dimension is large: without z, and with
/// the time and memory that the equations take, not d³ and d².
Vertex locate_vertex(const SlopeView& view, const Basis& basis);

/// How far one can go from the vertex along the polytope's edge k (the direction edge_direction(k)) before
/// another inequality stops it; +inf if nothing does. Inequalities in `basis` other than k hold along it.
double polytope_edge_length(const SlopeView& view, const Vertex& vertex, int k);

}  // namespace indet
