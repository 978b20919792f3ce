#pragma once

#include <optional>
#include <span>
#include <vector>

#include "libindet/barrier/basis_factor.h"
#include "libindet/barrier/block_structure.h"

namespace indet::barrier {

/// Vertices of {A x = b, x ≥ 0}, one after the other: all columns but those of a basis B, as many as A has
/// rows, are zero.
///
///   x_B = A_B⁻¹ b,   of an objective c: multipliers y = A_B⁻ᵀ c_B, reduced costs h = c − Aᵀ y
///
/// (Dantzig, Linear Programming and Extensions, 1963). Solved by the LU factor of A_B, and refined.
class BasisVertex {
 public:
  /// `structure` must outlive this. No basis yet.
  explicit BasisVertex(const BlockStructure& structure);

  /// Takes the columns of largest `rank` as basis, as many as there are rows; of equals those with smaller
  /// numbers; in place of columns that depend on others the next ones that do not. Returns whether the basis
  /// is regular, as far as double precision tells.
  bool set_basis(std::span<const double> rank);
  /// Another column in place of one of the basis; `along`: the direction of the entering one. Returns as
  /// above.
  bool exchange(int entering, int leaving, const std::vector<double>& along);
  /// The factor is new: there is no rounding of exchanges in it.
  bool is_fresh() const { return factor_.replaced() == 0; }

  /// The columns that are not in the basis, ascending.
  const std::vector<int>& closed() const { return closed_; }
  bool is_basic(int column) const { return place_[static_cast<std::size_t>(column)] >= 0; }

  /// x, exactly 0 at closed columns; negative where B is not feasible. `load`: b or another one, in the
  /// structure's order. Nothing where rounding leaves too much of it.
  std::optional<std::vector<double>> solution(std::span<const double> load) const;
  /// How x changes for each unit of x of a closed column, so that A x stays. Not refined, as is `row`.
  std::vector<double> direction(int entering) const;
  /// How the x of a basic column changes with that of each closed one.
  std::vector<double> row(int basic) const;
  /// y of an objective, one weight a column; its reduced costs take the place of these.
  std::vector<double> price(std::vector<double>& costs) const;

 private:
  bool take_independent(int place, const std::vector<int>& order);
  /// A_B⁻¹ a of a column a.
  std::vector<double> places_along(int column) const;

  const BlockStructure& structure_;
  BasisFactor factor_;
  std::vector<int> place_;  ///< in the basis, one a column; −1 if it is closed
  std::vector<int> closed_;
};

}  // namespace indet::barrier
