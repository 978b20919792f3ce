#pragma once

#include <cmath>

namespace indet {

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
  }
  void add_product(double x, double y) {
    const double product = x * y;
    add(product);
    rest_ += std::fma(x, y, -product);
  }
  double value() const { return sum_ + rest_; }

 private:
  double sum_ = 0;
  double rest_ = 0;
};

}  // namespace indet
