#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <memory>
#include <optional>
#include <vector>

#include "libindet/base/random.h"
#include "libindet/range/force_ranges.h"
#include "libindet/verify/rebuilt_problem.h"

namespace indet {

/// The directions in which the polytope F extends, as AffineHull has them, but without a kernel: for packings
/// of any size, and without states. In coordinates z along the directions d that edges which are open leave
/// to the force of each contact (the edges (1, ±μ)/max(1, μ) of its cone, those that are not closed in all
/// states),
///
///     F = Σ d z,   cd z = −w,   P = 1 − (cd)ᵀ (cd (cd)ᵀ)⁻¹ cd
///
/// projects on them. Random vectors stand in for its columns: where P r is 0 for some of them, so is the row.
class FreeDirections {
 public:
  /// Which edges are closed in all states is taken from the ranges: where both components of a contact have
  /// the same ranges as if one edge was. None if that does not leave dim F directions, or rounding no factor.
  static std::unique_ptr<const FreeDirections> of(const RebuiltProblem& problem, const Packing& packing,
                                                  const ForceRanges& ranges);

  /// Whether each component of the forces (2α: R_α, 2α + 1: T_α) can vary; none if that is not clear.
  std::optional<std::vector<bool>> varying() const;
  /// The number of independent parts of F: a set S of contacts is a sum of parts if P r, r random on S, is 0
  /// outside. None if that is not clear, or there are very many.
  std::optional<int> blocks() const;

 private:
  FreeDirections(const RebuiltProblem& problem, std::vector<Vector2> along, std::vector<int> contact);
  Eigen::VectorXd projected(Eigen::VectorXd r) const;
  Eigen::VectorXd random_direction(Random& random) const;
  /// Of each contact.
  Eigen::VectorXd lengths(const Eigen::VectorXd& v) const;

  Eigen::Index contacts_;
  std::vector<Vector2> along_;        ///< d, one a column
  std::vector<int> contact_;          ///< of each column; ascending
  Eigen::SparseMatrix<double> rows_;  ///< cd
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
};

}  // namespace indet
