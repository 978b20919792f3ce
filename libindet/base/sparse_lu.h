#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace indet {

/// P A Q = L U of a square sparse matrix A by KLU (Davis and Palamadai Natarajan, ACM Trans. Math. Softw. 37,
/// 36 (2010)): block triangular form, then a minimum degree order and partial pivoting in each block. The
/// only file pair that includes klu.h. To be used by one thread at a time.
class SparseLu {
 public:
  /// `least_share`: how small a pivot may be, relative to its column, where its place suits the order.
  /// `least_pivot`: above which a matrix is regular.
  explicit SparseLu(double least_share = 1e-3, double least_pivot = kLeastPivot);
  ~SparseLu();
  SparseLu(SparseLu&&) noexcept;

  /// A pivot below this, relative to its column, is rounding, or makes a matrix of large condition.
  static constexpr double kLeastPivot = 1e-9;

  /// A column that depends on others of the matrix, and a row that these leave free.
  struct Dependent {
    int column = 0;
    int row = 0;
  };
  /// Of the n × n matrix whose column j has `rows` and `entries` from first[j] to first[j + 1] − 1. Returns a
  /// column that depends on others, as far as double precision tells: none if the matrix is regular. Throws
  /// LibraryError if KLU fails.
  std::optional<Dependent> factor(std::span<int> first, std::span<int> rows, std::span<double> entries);

  /// r := A⁻¹ r and c := A⁻ᵀ c, of one vector or of several, one behind the other. Precondition: factor found
  /// the matrix regular.
  void solve(std::span<double> r) const;
  void solve_transposed(std::span<double> c) const;

  /// The block upper triangular form: no entry stands in a row of a later block than its column's.
  struct Blocks {
    int count = 0;
    std::vector<int> of_row, of_column;
  };
  Blocks blocks() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace indet
