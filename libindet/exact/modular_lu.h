#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "libindet/exact/integer_column.h"
#include "libindet/exact/prime_field.h"

namespace indet::exact {

/// P B Q = L U of a sparse matrix modulo a prime, pivots chosen for few non-zeros (Markowitz, Management Sci.
/// 3, 255 (1957)). The rank modulo p never exceeds the rank over the rationals.
class ModularLu {
 public:
  /// m × columns.size(), any shape.
  ModularLu(const PrimeField& field, int rows, const std::vector<const IntegerColumn*>& columns);

  int rank() const { return static_cast<int>(pivots_.size()); }
  /// Rows and columns of the pivots: independent ones, rank() of each; ascending.
  std::vector<int> pivot_rows() const;
  std::vector<int> pivot_columns() const;

  /// x with B x = b and y with Bᵀ y = c, plain numbers. Precondition: B is square and of full rank.
  std::vector<std::uint64_t> solve(std::vector<std::uint64_t> b) const;
  std::vector<std::uint64_t> solve_transposed(std::vector<std::uint64_t> c) const;

 private:
  using Entries = std::vector<std::pair<int, std::uint64_t>>;
  struct Pivot {
    int row = 0;
    int column = 0;
    std::uint64_t inverse = 0;
    Entries below;  ///< L: rows and factors
    Entries right;  ///< U: columns and values
  };
  const PrimeField& field_;
  std::vector<Pivot> pivots_;
};

/// Columns, taken greedily in the given order, that are independent modulo the prime of `field` on the given
/// rows (−1 in `row_number`: left out), at most `limit` of them. Returns positions in `order`.
std::vector<int> independent_prefix(const PrimeField& field, const std::vector<int>& row_number, int rows,
                                    const std::vector<const IntegerColumn*>& order, int limit);

}  // namespace indet::exact
