#include "libindet/base/sparse_lu.h"

#include <klu.h>

#include <cmath>

#include "libindet/base/error.h"

namespace indet {

struct SparseLu::Impl {
  Impl(double least_share, double pivot) : least_pivot(pivot) {
    klu_defaults(&common);
    common.halt_if_singular = 0;
    common.tol = least_share;
  }
  ~Impl() { clear(); }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void clear() {
    klu_free_numeric(&numeric, &common);
    klu_free_symbolic(&symbolic, &common);
  }

  klu_common common;
  double least_pivot;
  klu_symbolic* symbolic = nullptr;
  klu_numeric* numeric = nullptr;
};

SparseLu::SparseLu(double least_share, double least_pivot)
    : impl_(std::make_unique<Impl>(least_share, least_pivot)) {}
SparseLu::~SparseLu() = default;
SparseLu::SparseLu(SparseLu&&) noexcept = default;

std::optional<SparseLu::Dependent> SparseLu::factor(std::span<int> first, std::span<int> rows,
                                                    std::span<double> entries) {
  impl_->clear();
  const auto size = static_cast<int>(first.size()) - 1;
  klu_common& common = impl_->common;
  impl_->symbolic = klu_analyze(size, first.data(), rows.data(), &common);
  if (impl_->symbolic != nullptr)
    impl_->numeric = klu_factor(first.data(), rows.data(), entries.data(), impl_->symbolic, &common);
  if (impl_->numeric == nullptr) throw LibraryError("a sparse matrix could not be factorised (KLU)");
  // Behind the first pivot that vanishes there are no numbers.
  const auto* pivots = static_cast<const double*>(impl_->numeric->Udiag);
  for (int k = 0; k < size; ++k) {
    if (!(std::abs(pivots[k]) > impl_->least_pivot))
      return Dependent{impl_->symbolic->Q[k], impl_->numeric->Pnum[k]};
  }
  return {};
}

void SparseLu::solve(std::span<double> r) const {
  const int size = impl_->symbolic->n;
  klu_solve(impl_->symbolic, impl_->numeric, size, static_cast<int>(r.size()) / size, r.data(),
            &impl_->common);
}

void SparseLu::solve_transposed(std::span<double> c) const {
  const int size = impl_->symbolic->n;
  klu_tsolve(impl_->symbolic, impl_->numeric, size, static_cast<int>(c.size()) / size, c.data(),
             &impl_->common);
}

SparseLu::Blocks SparseLu::blocks() const {
  const klu_symbolic& symbolic = *impl_->symbolic;
  Blocks blocks;
  blocks.count = symbolic.nblocks;
  blocks.of_row.resize(static_cast<std::size_t>(symbolic.n));
  blocks.of_column.resize(static_cast<std::size_t>(symbolic.n));
  for (int block = 0; block < symbolic.nblocks; ++block) {
    for (int k = symbolic.R[block]; k < symbolic.R[block + 1]; ++k) {
      blocks.of_row[static_cast<std::size_t>(symbolic.P[k])] = block;
      blocks.of_column[static_cast<std::size_t>(symbolic.Q[k])] = block;
    }
  }
  return blocks;
}

}  // namespace indet
