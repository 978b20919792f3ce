#include "libindet/exact/modular_lu.h"

#include <algorithm>
#include <limits>

namespace indet::exact {
namespace {

/// The rows of a matrix under elimination, with the rows that each column touches.
class Elimination {
 public:
  using Entries = std::vector<std::pair<int, std::uint64_t>>;

  Elimination(const PrimeField& field, int rows, const std::vector<const IntegerColumn*>& columns)
      : field_(field),
        rows_(static_cast<std::size_t>(rows)),
        touched_(columns.size()),
        count_(columns.size(), 0),
        place_(columns.size(), -1) {
    for (std::size_t j = 0; j < columns.size(); ++j) {
      for (std::size_t k = 0; k < columns[j]->row.size(); ++k) {
        const std::uint64_t value = field.scaled(field.reduce(columns[j]->value[k]));
        if (value == 0) continue;
        const int i = columns[j]->row[k];
        row(i).emplace_back(static_cast<int>(j), value);
        touched_[j].push_back(i);
        ++count_[j];
      }
    }
  }

  Entries& row(int i) { return rows_[static_cast<std::size_t>(i)]; }
  const std::vector<int>& rows_of(int j) const { return touched_[static_cast<std::size_t>(j)]; }
  int count(int j) const { return count_[static_cast<std::size_t>(j)]; }
  void forget(const Entries& entries) {
    for (const auto& [j, value] : entries) --count_[static_cast<std::size_t>(j)];
  }

  /// row(target) −= factor · pivot row, both without the pivot column.
  void subtract(int target, const Entries& pivot, std::uint64_t factor) {
    Entries& entries = row(target);
    for (std::size_t k = 0; k < entries.size(); ++k)
      place_[static_cast<std::size_t>(entries[k].first)] = static_cast<int>(k);
    for (const auto& [j, value] : pivot) {
      const std::uint64_t change = field_.multiply(factor, value);
      const int at = place_[static_cast<std::size_t>(j)];
      if (at >= 0) {
        auto& entry = entries[static_cast<std::size_t>(at)];
        entry.second = field_.subtract(entry.second, change);
      } else {
        entries.emplace_back(j, field_.subtract(0, change));
        touched_[static_cast<std::size_t>(j)].push_back(target);
        ++count_[static_cast<std::size_t>(j)];
      }
    }
    for (const auto& entry : entries) place_[static_cast<std::size_t>(entry.first)] = -1;
    std::erase_if(entries, [&](const auto& entry) {
      if (entry.second != 0) return false;
      --count_[static_cast<std::size_t>(entry.first)];
      return true;
    });
  }

 private:
  const PrimeField& field_;
  std::vector<Entries> rows_;
  std::vector<std::vector<int>> touched_;  ///< may name rows whose entry has vanished, or a row twice
  std::vector<int> count_;
  std::vector<int> place_;
};

}  // namespace

ModularLu::ModularLu(const PrimeField& field, int rows, const std::vector<const IntegerColumn*>& columns)
    : field_(field) {
  Elimination work(field, rows, columns);
  std::vector<bool> done(static_cast<std::size_t>(rows), false);
  // Rows by their number of entries; an entry is out of date when the row has changed since.
  std::vector<std::vector<int>> by_length(columns.size() + 1);
  const auto enqueue = [&](int i) { by_length[work.row(i).size()].push_back(i); };
  for (int i = 0; i < rows; ++i) enqueue(i);
  std::size_t length = 1;
  while (length < by_length.size()) {
    if (by_length[length].empty()) {
      ++length;
      continue;
    }
    const int i = by_length[length].back();
    by_length[length].pop_back();
    if (done[static_cast<std::size_t>(i)] || work.row(i).size() != length) continue;
    done[static_cast<std::size_t>(i)] = true;
    auto entries = std::move(work.row(i));
    work.row(i).clear();
    work.forget(entries);
    const auto best = std::min_element(entries.begin(), entries.end(), [&](const auto& a, const auto& b) {
      return std::pair(work.count(a.first), a.first) < std::pair(work.count(b.first), b.first);
    });
    Pivot pivot;
    pivot.row = i;
    pivot.column = best->first;
    pivot.inverse = field.inverse(best->second);
    entries.erase(best);
    for (const int other : std::vector<int>(work.rows_of(pivot.column))) {
      if (done[static_cast<std::size_t>(other)]) continue;
      auto& target = work.row(other);
      const auto at = std::find_if(target.begin(), target.end(),
                                   [&](const auto& entry) { return entry.first == pivot.column; });
      if (at == target.end()) continue;
      const std::uint64_t factor = field.multiply(at->second, pivot.inverse);
      target.erase(at);
      pivot.below.emplace_back(other, factor);
      work.subtract(other, entries, factor);
      enqueue(other);
      length = std::min(length, std::max<std::size_t>(1, work.row(other).size()));
    }
    pivot.right = std::move(entries);
    pivots_.push_back(std::move(pivot));
  }
}

std::vector<int> ModularLu::pivot_rows() const {
  std::vector<int> rows;
  for (const Pivot& pivot : pivots_) rows.push_back(pivot.row);
  std::sort(rows.begin(), rows.end());
  return rows;
}

std::vector<int> ModularLu::pivot_columns() const {
  std::vector<int> columns;
  for (const Pivot& pivot : pivots_) columns.push_back(pivot.column);
  std::sort(columns.begin(), columns.end());
  return columns;
}

std::vector<std::uint64_t> ModularLu::solve(std::vector<std::uint64_t> b) const {
  for (const Pivot& pivot : pivots_) {
    const std::uint64_t value = b[static_cast<std::size_t>(pivot.row)];
    if (value == 0) continue;
    for (const auto& [i, factor] : pivot.below) {
      auto& entry = b[static_cast<std::size_t>(i)];
      entry = field_.subtract(entry, field_.multiply(factor, value));
    }
  }
  std::vector<std::uint64_t> x(b.size(), 0);
  for (auto pivot = pivots_.rbegin(); pivot != pivots_.rend(); ++pivot) {
    std::uint64_t value = b[static_cast<std::size_t>(pivot->row)];
    for (const auto& [j, factor] : pivot->right) {
      const std::uint64_t known = x[static_cast<std::size_t>(j)];
      if (known != 0) value = field_.subtract(value, field_.multiply(factor, known));
    }
    x[static_cast<std::size_t>(pivot->column)] = field_.multiply(pivot->inverse, value);
  }
  return x;
}

std::vector<std::uint64_t> ModularLu::solve_transposed(std::vector<std::uint64_t> c) const {
  std::vector<std::uint64_t> y(c.size(), 0);
  for (const Pivot& pivot : pivots_) {
    const std::uint64_t value = field_.multiply(pivot.inverse, c[static_cast<std::size_t>(pivot.column)]);
    y[static_cast<std::size_t>(pivot.row)] = value;
    if (value == 0) continue;
    for (const auto& [j, factor] : pivot.right) {
      auto& entry = c[static_cast<std::size_t>(j)];
      entry = field_.subtract(entry, field_.multiply(factor, value));
    }
  }
  for (auto pivot = pivots_.rbegin(); pivot != pivots_.rend(); ++pivot) {
    std::uint64_t& value = y[static_cast<std::size_t>(pivot->row)];
    for (const auto& [i, factor] : pivot->below) {
      const std::uint64_t known = y[static_cast<std::size_t>(i)];
      if (known != 0) value = field_.subtract(value, field_.multiply(factor, known));
    }
  }
  return y;
}

std::vector<int> independent_prefix(const PrimeField& field, const std::vector<int>& row_number, int rows,
                                    const std::vector<const IntegerColumn*>& order, int limit) {
  struct Reduced {
    int pivot_row;
    std::uint64_t inverse;
    std::vector<std::pair<int, std::uint64_t>> entries;  ///< without the pivot
  };
  std::vector<Reduced> reduced;
  std::vector<int> chosen;
  for (std::size_t position = 0; position < order.size(); ++position) {
    if (static_cast<int>(chosen.size()) == limit) break;
    std::vector<std::uint64_t> column(static_cast<std::size_t>(rows), 0);
    for (std::size_t k = 0; k < order[position]->row.size(); ++k) {
      const int row = row_number[static_cast<std::size_t>(order[position]->row[k])];
      if (row >= 0)
        column[static_cast<std::size_t>(row)] = field.scaled(field.reduce(order[position]->value[k]));
    }
    for (const Reduced& earlier : reduced) {
      const std::uint64_t value = column[static_cast<std::size_t>(earlier.pivot_row)];
      if (value == 0) continue;
      const std::uint64_t factor = field.multiply(value, earlier.inverse);
      column[static_cast<std::size_t>(earlier.pivot_row)] = 0;
      for (const auto& [i, entry] : earlier.entries) {
        auto& target = column[static_cast<std::size_t>(i)];
        target = field.subtract(target, field.multiply(factor, entry));
      }
    }
    Reduced next{-1, 0, {}};
    for (int i = 0; i < rows; ++i) {
      const std::uint64_t value = column[static_cast<std::size_t>(i)];
      if (value == 0) continue;
      if (next.pivot_row < 0) {
        next.pivot_row = i;
        next.inverse = field.inverse(value);
      } else {
        next.entries.emplace_back(i, value);
      }
    }
    if (next.pivot_row < 0) continue;
    reduced.push_back(std::move(next));
    chosen.push_back(static_cast<int>(position));
  }
  return chosen;
}

}  // namespace indet::exact
