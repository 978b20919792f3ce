#include "libindet/exact/integer_column.h"

namespace indet::exact {

IntegerColumn integer_terms(const Terms& terms) {
  mpz_class denominator = 1;
  for (const auto& [row, value] : terms) denominator = lcm(denominator, value.get_den());
  IntegerColumn column;
  column.shift = static_cast<long>(mpz_sizeinbase(denominator.get_mpz_t(), 2)) - 1;
  for (const auto& [row, value] : terms) {
    column.row.push_back(row);
    column.value.push_back(mpq_class(value * denominator).get_num());
  }
  return column;
}

mpq_class scaled(const mpq_class& value, long power) {
  mpq_class result;
  if (power >= 0) {
    mpq_mul_2exp(result.get_mpq_t(), value.get_mpq_t(), static_cast<mp_bitcnt_t>(power));
  } else {
    mpq_div_2exp(result.get_mpq_t(), value.get_mpq_t(), static_cast<mp_bitcnt_t>(-power));
  }
  return result;
}

}  // namespace indet::exact
