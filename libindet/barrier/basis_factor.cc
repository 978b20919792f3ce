#include "libindet/barrier/basis_factor.h"

#include <klu.h>

#include <cmath>
#include <cstddef>

#include "libindet/barrier/stored_entries.h"
#include "libindet/barrier/vectors.h"
#include "libindet/base/error.h"

namespace indet::barrier {
namespace {

/// So many replaced columns cost about as much in each solution as the factor itself.
constexpr std::size_t kMostReplaced = 50;
/// A pivot below this, relative to its column, is rounding, or makes a matrix of large condition.
constexpr double kLeastPivot = 1e-9;

}  // namespace

/// KLU's factor of one matrix.
struct BasisFactor::Lu {
  Lu() {
    klu_defaults(&common);
    common.halt_if_singular = 0;
  }
  ~Lu() { clear(); }
  Lu(const Lu&) = delete;
  Lu& operator=(const Lu&) = delete;

  void clear() {
    klu_free_numeric(&numeric, &common);
    klu_free_symbolic(&symbolic, &common);
  }

  klu_common common;
  klu_symbolic* symbolic = nullptr;
  klu_numeric* numeric = nullptr;
};

BasisFactor::BasisFactor(const BlockStructure& structure) : lu_(std::make_unique<Lu>()) {
  first_entry_.assign(static_cast<std::size_t>(structure.columns()) + 1, 0);
  for_each_entry(structure, [&](std::size_t column, std::size_t row, double entry) {
    if (entry == 0) return;
    row_.push_back(static_cast<int>(row));
    entry_.push_back(entry);
    ++first_entry_[column + 1];
  });
  for (std::size_t k = 1; k < first_entry_.size(); ++k) first_entry_[k] += first_entry_[k - 1];
}

BasisFactor::~BasisFactor() = default;
BasisFactor::BasisFactor(BasisFactor&&) noexcept = default;

std::optional<BasisFactor::Dependent> BasisFactor::factor(std::span<const int> basis) {
  basis_.assign(basis.begin(), basis.end());
  replaced_.clear();
  lu_->clear();
  std::vector<int> first{0}, rows;
  std::vector<double> entries;
  for (const int column : basis) {
    if (const int row = column - unit_column(0); row >= 0) {
      rows.push_back(row);
      entries.push_back(1);
    } else {
      const auto begin = first_entry_[static_cast<std::size_t>(column)];
      const auto end = first_entry_[static_cast<std::size_t>(column) + 1];
      rows.insert(rows.end(), row_.begin() + begin, row_.begin() + end);
      entries.insert(entries.end(), entry_.begin() + begin, entry_.begin() + end);
    }
    first.push_back(static_cast<int>(rows.size()));
  }
  const auto size = static_cast<int>(basis.size());
  lu_->symbolic = klu_analyze(size, first.data(), rows.data(), &lu_->common);
  if (lu_->symbolic != nullptr)
    lu_->numeric = klu_factor(first.data(), rows.data(), entries.data(), lu_->symbolic, &lu_->common);
  if (lu_->numeric == nullptr) throw LibraryError("the basis of a state could not be factorised (KLU)");
  // Behind the first pivot that vanishes there are no numbers.
  const auto* pivots = static_cast<const double*>(lu_->numeric->Udiag);
  for (int k = 0; k < size; ++k) {
    if (!(std::abs(pivots[k]) > kLeastPivot)) return Dependent{lu_->symbolic->Q[k], lu_->numeric->Pnum[k]};
  }
  return {};
}

bool BasisFactor::replace(int p, int column, std::span<const double> along) {
  const double pivot = along[static_cast<std::size_t>(p)];
  basis_[static_cast<std::size_t>(p)] = column;
  const bool is_safe = std::abs(pivot) > kLeastPivot * largest_entry(along);
  if (!is_safe || replaced_.size() == kMostReplaced) return !factor(std::vector<int>(basis_));
  Elementary& next = replaced_.emplace_back();
  next.p = p;
  next.pivot = pivot;
  for (std::size_t i = 0; i < along.size(); ++i) {
    if (along[i] == 0 || static_cast<int>(i) == p) continue;
    next.rows.push_back(static_cast<int>(i));
    next.values.push_back(along[i]);
  }
  return true;
}

void BasisFactor::solve(std::vector<double>& r) const {
  klu_solve(lu_->symbolic, lu_->numeric, static_cast<int>(r.size()), 1, r.data(), &lu_->common);
  for (const Elementary& next : replaced_) {
    double& at_p = r[static_cast<std::size_t>(next.p)];
    at_p /= next.pivot;
    if (at_p == 0) continue;
    for (std::size_t k = 0; k < next.rows.size(); ++k)
      r[static_cast<std::size_t>(next.rows[k])] -= next.values[k] * at_p;
  }
}

void BasisFactor::solve_transposed(std::vector<double>& c) const {
  for (auto next = replaced_.rbegin(); next != replaced_.rend(); ++next) {
    double& at_p = c[static_cast<std::size_t>(next->p)];
    for (std::size_t k = 0; k < next->rows.size(); ++k)
      at_p -= next->values[k] * c[static_cast<std::size_t>(next->rows[k])];
    at_p /= next->pivot;
  }
  klu_tsolve(lu_->symbolic, lu_->numeric, static_cast<int>(c.size()), 1, c.data(), &lu_->common);
}

}  // namespace indet::barrier
