#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "libindet/equilibrium/equilibrium_problem.h"
#include "libindet/polytope/force_polytope.h"

namespace indet {

/// A linear functional by its coefficients on the unknowns u and on the edges x of a problem, ascending.
/// Where these are sums in which digits cancel, `sizes` are those of their parts.
struct Functional {
  std::vector<std::pair<int, double>> on_unknowns, on_edges;
  std::vector<double> unknown_sizes, edge_sizes;  ///< empty: the sizes of the coefficients

  double edge_size(std::size_t k) const {
    return edge_sizes.empty() ? std::abs(on_edges[k].second) : edge_sizes[k];
  }
  double unknown_size(std::size_t k) const {
    return unknown_sizes.empty() ? std::abs(on_unknowns[k].second) : unknown_sizes[k];
  }
  double at(const Eigen::VectorXd& u) const;
  /// Bound of what the roundings of the coefficients on edges change where 0 ≤ x ≤ `strength`.
  double rounding(const std::vector<double>& strength) const;
  Functional opposite() const;
};

/// Σ on_forces · (R_1, T_1, …, R_M, T_M).
Functional sum_of_forces(const EquilibriumProblem& problem, const Eigen::VectorXd& on_forces);

/// The normal or the tangential force of a contact, times a sign; `first`:
/// EquilibriumProblem::first_unknowns. Nothing of a contact that is open.
Functional force_component(const EquilibriumProblem& problem, const std::vector<int>& first,
                           Eigen::Index contact, bool tangential, double sign);

/// The part of a functional that lives on a block.
Objective objective_on(const PolytopeBlock& block, const Functional& f);

}  // namespace indet
