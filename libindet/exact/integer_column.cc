#include "libindet/exact/integer_column.h"

namespace indet::exact {

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
