#pragma once

#include <memory>
#include <span>
#include <vector>

#include "libindet/barrier/block_structure.h"

namespace indet::barrier {

/// The Cholesky factor of S A D Aᵀ S − shift · 1 for one D, with rows in the order of a BlockStructure.
class BlockCholesky {
 public:
  /// `structure` must outlive this.
  explicit BlockCholesky(const BlockStructure& structure);
  ~BlockCholesky();
  BlockCholesky(BlockCholesky&&) noexcept;

  /// D > 0, one a column of A; `scale`: S, one factor a row, empty for 1. Returns whether all pivots came out
  /// positive (one that vanishes is made huge, as if its row were left out).
  bool factor(std::span<const double> D, std::span<const double> scale = {}, double shift = 0);
  /// y := (L Lᵀ)⁻¹ y.
  void solve(std::span<double> y) const;

  /// L, in the blocks of the structure, and the inverses of its diagonal, by rows.
  std::span<const double> values() const;
  std::span<const double> inverse_diagonal() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Aᵀ y and A x, with rows in the order of the structure.
std::vector<double> transposed_product(const BlockStructure& structure, std::span<const double> y);
std::vector<double> product(const BlockStructure& structure, std::span<const double> x);

}  // namespace indet::barrier
