#pragma once

#include <gmpxx.h>

#include <vector>

namespace indet::exact {

/// A sparse column with integer entries: value[i] stands in row row[i], rows ascending. The true entry is
/// value · 2^−shift.
struct IntegerColumn {
  std::vector<int> row;
  std::vector<mpz_class> value;
  long shift = 0;
};

/// value · 2^power.
mpq_class scaled(const mpq_class& value, long power);

}  // namespace indet::exact
