#pragma once

#include <gmpxx.h>

#include <utility>
#include <vector>

namespace indet::exact {

/// A sparse column with integer entries: value[i] stands in row row[i], rows ascending. The true entry is
/// value · 2^−shift.
struct IntegerColumn {
  std::vector<int> row;
  std::vector<mpz_class> value;
  long shift = 0;
};

/// (row, true entry), rows ascending; entries are binary fractions.
using Terms = std::vector<std::pair<int, mpq_class>>;
IntegerColumn integer_terms(const Terms& terms);

/// value · 2^power.
mpq_class scaled(const mpq_class& value, long power);

}  // namespace indet::exact
