#pragma once

#include <cstdint>
#include <vector>

#include "libindet/base/random.h"
#include "libindet/exact/integer_column.h"

namespace indet::exact {

/// A sparse matrix of small integers, by columns.
inline std::vector<IntegerColumn> random_matrix(int size, int entries, std::uint64_t seed) {
  Random random(seed);
  std::vector<IntegerColumn> columns(static_cast<std::size_t>(size));
  for (int j = 0; j < size; ++j) {
    IntegerColumn& column = columns[static_cast<std::size_t>(j)];
    for (int i = 0; i < size; ++i) {
      if (i != j && random.uniform(0, size) > entries) continue;
      column.row.push_back(i);
      column.value.emplace_back(static_cast<long>(random.uniform(-1e15, 1e15)));
    }
  }
  return columns;
}

inline std::vector<const IntegerColumn*> pointers_to(const std::vector<IntegerColumn>& columns) {
  std::vector<const IntegerColumn*> result;
  for (const IntegerColumn& column : columns) result.push_back(&column);
  return result;
}

}  // namespace indet::exact
