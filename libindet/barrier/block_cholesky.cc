#include "libindet/barrier/block_cholesky.h"

#include <algorithm>
#include <cstddef>
#include <memory>

#include "libindet/barrier/aligned_memory.h"
#include "libindet/base/tolerances.h"

namespace indet::barrier {
namespace {

using tolerance::kHugePivot;
using tolerance::kVanishingPivot;

/// One problem at a time.
namespace single {
using Register = double;
constexpr int kRegisters = 1;
#include "libindet/barrier/kernels.inc"
}  // namespace single

const single::Pack* packs(const double* values) { return reinterpret_cast<const single::Pack*>(values); }
single::Pack* packs(double* values) { return reinterpret_cast<single::Pack*>(values); }

}  // namespace

struct BlockCholesky::Impl {
  explicit Impl(const BlockStructure& s) : structure(s), cholesky(s) {}
  const BlockStructure& structure;
  single::Cholesky cholesky;
};

BlockCholesky::BlockCholesky(const BlockStructure& structure) : impl_(std::make_unique<Impl>(structure)) {}
BlockCholesky::~BlockCholesky() = default;
BlockCholesky::BlockCholesky(BlockCholesky&&) noexcept = default;

bool BlockCholesky::factor(std::span<const double> D, std::span<const double> scale, double shift) {
  return impl_->cholesky.factor(packs(D.data()), scale.empty() ? nullptr : scale.data(), shift);
}

void BlockCholesky::solve(std::span<double> y) const { impl_->cholesky.solve(packs(y.data())); }

std::span<const double> BlockCholesky::values() const {
  return {reinterpret_cast<const double*>(impl_->cholesky.values()),
          static_cast<std::size_t>(impl_->structure.values())};
}

std::span<const double> BlockCholesky::inverse_diagonal() const {
  return {reinterpret_cast<const double*>(impl_->cholesky.inverse_diagonal()),
          static_cast<std::size_t>(impl_->structure.rows())};
}

std::vector<double> transposed_product(const BlockStructure& structure, std::span<const double> y) {
  std::vector<double> result(static_cast<std::size_t>(structure.columns()));
  for (const BlockStructure::Group& group : structure.groups())
    single::transposed_product(structure, group, packs(y.data()), packs(result.data()) + group.first_column);
  return result;
}

std::vector<double> product(const BlockStructure& structure, std::span<const double> x) {
  std::vector<double> result(static_cast<std::size_t>(structure.rows()), 0.0);
  for (const BlockStructure::Group& group : structure.groups())
    single::subtract_product(structure, group, packs(x.data()) + group.first_column, packs(result.data()));
  for (double& value : result) value = -value;
  return result;
}

}  // namespace indet::barrier
