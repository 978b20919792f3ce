#pragma once

#include <vector>

#include "libindet/base/sparse_lu.h"
#include "libindet/exact/integer_column.h"

namespace indet::exact {

/// The block upper triangular form of a regular square matrix B: as many rows as columns a block, and no
/// entry in a row of a later block than its column's. Then every block is regular, and what a block has to do
/// with a solution can be told from zeros alone:
///
///   B x = b:    x_k follows from b_k and from later blocks,     and x_k = 0 if all of these are
///   Bᵀ y = c:   y_k follows from c_k and from earlier blocks
class BlockForm {
 public:
  /// One block.
  explicit BlockForm(std::size_t size) : of_row_(size, 0), of_column_(size, 0), above_(1) {}
  /// As proposed; one block if that is not such a form.
  BlockForm(const std::vector<const IntegerColumn*>& columns, SparseLu::Blocks proposed);

  using Blocks = std::vector<bool>;  ///< a set of them
  std::size_t count() const { return above_.size(); }
  int of_row(std::size_t i) const { return of_row_[i]; }
  int of_column(std::size_t j) const { return of_column_[j]; }
  int of_unknown(std::size_t i, bool transposed) const { return transposed ? of_row_[i] : of_column_[i]; }
  int of_equation(std::size_t i, bool transposed) const { return transposed ? of_column_[i] : of_row_[i]; }

  /// Those in which a solution need not be 0.
  Blocks reached(const std::vector<mpz_class>& right, bool transposed) const;
  /// Those whose equations these unknowns follow from.
  Blocks needed(const std::vector<int>& unknowns, bool transposed) const;

 private:
  void spread_to_earlier(Blocks& blocks) const;
  void spread_to_later(Blocks& blocks) const;

  std::vector<int> of_row_, of_column_;
  std::vector<std::vector<int>>
      above_;  ///< of each block: earlier ones in whose rows its columns have entries
};

}  // namespace indet::exact
