#include "libindet/barrier/basis_factor.h"

#include <cmath>
#include <cstddef>

#include "libindet/barrier/stored_entries.h"
#include "libindet/barrier/vectors.h"

namespace indet::barrier {
namespace {

/// So many replaced columns cost about as much in each solution as the factor itself.
constexpr std::size_t kMostReplaced = 50;

}  // namespace

BasisFactor::BasisFactor(const BlockStructure& structure) {
  first_entry_.assign(static_cast<std::size_t>(structure.columns()) + 1, 0);
  for_each_entry(structure, [&](std::size_t column, std::size_t row, double entry) {
    if (entry == 0) return;
    row_.push_back(static_cast<int>(row));
    entry_.push_back(entry);
    ++first_entry_[column + 1];
  });
  for (std::size_t k = 1; k < first_entry_.size(); ++k) first_entry_[k] += first_entry_[k - 1];
}

std::optional<SparseLu::Dependent> BasisFactor::factor(std::span<const int> basis) {
  basis_.assign(basis.begin(), basis.end());
  replaced_.clear();
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
  return lu_.factor(first, rows, entries);
}

bool BasisFactor::replace(int p, int column, std::span<const double> along) {
  const double pivot = along[static_cast<std::size_t>(p)];
  basis_[static_cast<std::size_t>(p)] = column;
  const bool is_safe = std::abs(pivot) > SparseLu::kLeastPivot * largest_entry(along);
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
  lu_.solve(r);
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
  lu_.solve_transposed(c);
}

}  // namespace indet::barrier
