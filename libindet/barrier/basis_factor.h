#pragma once

#include <optional>
#include <span>
#include <vector>

#include "libindet/barrier/block_structure.h"
#include "libindet/base/sparse_lu.h"

namespace indet::barrier {

/// The LU factor of a square matrix of columns of A, with rows in the order of a BlockStructure: by
/// KLU, and after that by one elementary matrix for each column that another one has replaced (the product
/// form of the inverse, Dantzig and Orchard-Hays 1954), until there are many of these.
class BasisFactor {
 public:
  explicit BasisFactor(const BlockStructure& structure);

  /// Column p of the matrix is column basis[p] of A, or the unit vector of row i if that is unit_column(i).
  /// Returns a column that depends on others, as far as double precision tells: none if the matrix is
  /// regular.
  std::optional<SparseLu::Dependent> factor(std::span<const int> basis);
  int unit_column(int row) const { return static_cast<int>(first_entry_.size()) - 1 + row; }
  /// The same with another column of A, a, at place p; `along`: A_B⁻¹ a. Returns as above; if not, the next
  /// call has to be `factor`.
  bool replace(int p, int column, std::span<const double> along);
  /// Columns that were replaced since the last LU factorisation.
  std::size_t replaced() const { return replaced_.size(); }
  /// The columns of A at each place.
  const std::vector<int>& basis() const { return basis_; }

  /// r := A_B⁻¹ r and c := A_B⁻ᵀ c. Precondition: factor or replace succeeded.
  void solve(std::vector<double>& r) const;
  void solve_transposed(std::vector<double>& c) const;

 private:
  /// Identity but for column p.
  struct Elementary {
    int p = 0;
    double pivot = 1;
    std::vector<int> rows;  ///< others
    std::vector<double> values;
  };

  std::vector<int> first_entry_, row_;  ///< A, column by column
  std::vector<double> entry_;
  std::vector<int> basis_;
  SparseLu lu_;
  std::vector<Elementary> replaced_;
};

}  // namespace indet::barrier
