#pragma once

#include <cmath>

#include "libindet/base/rounding_bounds.h"

namespace indet {

/// A number in twice the precision of a double: high + low, with |low| ≤ u |high|.
struct Doubled {
  double high = 0, low = 0;

  /// high + low of any two doubles of which `high` is the larger one.
  static Doubled of(double high, double low) {
    const double sum = high + low;
    return {sum, low - (sum - high)};
  }
  double rounded() const { return high + low; }
  bool is_zero() const { return high == 0; }
};

/// x y and x + y, within some u² of the result (of the larger term of a sum).
inline Doubled product(const Doubled& x, double y) {
  const double high = x.high * y;
  return Doubled::of(high, std::fma(x.high, y, -high) + x.low * y);
}
inline Doubled sum(const Doubled& x, double y) {
  const double high = x.high + y;
  const double part = high - x.high;
  return Doubled::of(high, (x.high - (high - part)) + (y - part) + x.low);
}

/// A sum of numbers and products in twice the precision of a double (Ogita, Rump, Oishi, SIAM J. Sci. Comput.
/// 26, 1955): each addition and product leaves its rounding, and these are summed beside. Of two numbers the
/// sum is the nearest double; of a few it differs from the exact one by 1 rounding of the result and about
/// 1e-31 of the terms.
class DoubledSum {
 public:
  void add(double term) {
    const double sum = sum_ + term;
    const double part = sum - sum_;
    rest_ += (sum_ - (sum - part)) + (term - part);
    sum_ = sum;
    size_ += std::abs(term);
    ++terms_;
  }
  void add(const Doubled& term) {
    add(term.high);
    rest_ += term.low;
  }
  void add_product(double x, double y) {
    const double product = x * y;
    add(product);
    rest_ += std::fma(x, y, -product);
  }
  void add_product(const Doubled& x, const Doubled& y) {
    const double product = x.high * y.high;
    add(product);
    rest_ += std::fma(x.high, y.high, -product) + (x.high * y.low + x.low * y.high);
  }

  double value() const { return sum_ + rest_; }
  /// The same in twice the precision: it differs from the exact sum by at most error().
  Doubled doubled() const {
    DoubledSum both;
    both.add(sum_);
    both.add(rest_);
    return Doubled::of(both.sum_, both.rest_);
  }
  /// Each of n terms leaves two roundings in a sum of numbers of u times the terms; and each factor may
  /// itself be off by 16 u² of it.
  double error() const {
    const double n = terms_ + 3;
    return kWiden * 4 * n * n * (kRoundoff * kRoundoff) * size_ + kTiny;
  }
  /// Nothing was added but zeros: the sum is exactly 0.
  bool is_zero() const { return size_ == 0; }

 private:
  double sum_ = 0;
  double rest_ = 0;
  double size_ = 0;  ///< Σ |terms|
  double terms_ = 0;
};

}  // namespace indet
