#pragma once

#include <span>
#include <vector>

#include "libindet/barrier/block_cholesky.h"
#include "libindet/barrier/block_structure.h"

namespace indet::barrier {

/// Vertices of {A x = b, x ≥ 0}, one after the other: all columns but those of a basis B, as many as A has
/// rows, are zero.
///
///   x_B = A_B⁻¹ b,   of an objective c: multipliers y = A_B⁻ᵀ c_B, reduced costs h = c − Aᵀ y
///
/// (Dantzig, Linear Programming and Extensions, 1963). Solved by the Cholesky factor of A_B A_Bᵀ, which has
/// the structure of all others here, and refined, since that product squares the condition.
class BasisVertex {
 public:
  /// `structure` must outlive this. No basis yet.
  explicit BasisVertex(const BlockStructure& structure);

  /// Takes the columns of largest `rank` as basis, as many as there are rows; of equals those with smaller
  /// numbers. Returns whether they are independent, as far as double precision tells.
  bool set_basis(std::span<const double> rank);
  /// Another column in place of one of the basis. Returns as above.
  bool exchange(int entering, int leaving);

  /// The columns that are not in the basis, ascending.
  const std::vector<int>& closed() const { return closed_; }
  bool is_basic(int column) const { return is_basic_[static_cast<std::size_t>(column)] > 0; }

  /// x, exactly 0 at closed columns; negative where B is not feasible.
  const std::vector<double>& x() const { return x_; }
  /// The same for another b, in the structure's order.
  std::vector<double> solution(std::span<const double> load) const;
  /// How x changes for each unit of x of a closed column, so that A x stays.
  std::vector<double> direction(int entering) const;
  /// y of an objective, one weight a column; its reduced costs take the place of these.
  std::vector<double> price(std::vector<double>& costs) const;

 private:
  bool factor();

  const BlockStructure& structure_;
  BlockCholesky cholesky_;
  std::vector<double> is_basic_;  ///< 1 or 0, one a column
  std::vector<int> closed_;
  std::vector<double> x_;
};

}  // namespace indet::barrier
