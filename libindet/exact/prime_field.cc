#include "libindet/exact/prime_field.h"

namespace indet::exact {

PrimeField::PrimeField(std::uint64_t p) : p_(p) {
  std::uint64_t inverse = p;  // Newton: each step doubles the number of right digits
  for (int step = 0; step < 6; ++step) inverse *= 2 - p * inverse;
  inverse_ = ~inverse + 1;
  const Wide radix = (static_cast<Wide>(1) << 64U) % p;
  square_ = static_cast<std::uint64_t>(radix * radix % p);
}

std::uint64_t PrimeField::inverse(std::uint64_t scaled) const {
  std::uint64_t result = multiply(square_, 1);  // scaled 1
  std::uint64_t power = scaled;
  for (std::uint64_t exponent = p_ - 2; exponent > 0; exponent >>= 1U) {
    if ((exponent & 1U) != 0) result = multiply(result, power);
    power = multiply(power, power);
  }
  return result;
}

std::uint64_t large_prime(int k) {
  mpz_class candidate = (mpz_class(1) << 62U) - 1;
  for (;; candidate -= 2) {
    // GMP 6.2 runs a Baillie–PSW test, which has no exception below 2^64.
    if (mpz_probab_prime_p(candidate.get_mpz_t(), 25) != 0 && k-- == 0) return candidate.get_ui();
  }
}

}  // namespace indet::exact
