#pragma once

#include <array>
#include <cstdint>

namespace indet {

/// xoshiro256++ (Blackman & Vigna, ACM Trans. Math. Softw. 47, 36 (2021)), seeded by SplitMix64.
/// Its streams are the same on any machine and with any standard library, unlike those of
/// std::*_distribution.
class Random {
 public:
  /// Streams of one seed are independent of each other: chain 0, chain 1, …
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0);

  /// 64 random bits.
  std::uint64_t bits();
  /// Uniform in [0, 1), a multiple of 2⁻⁵³.
  double uniform();
  /// Uniform in [low, high).
  double uniform(double low, double high);
  /// Uniform in {0, …, n − 1}, without bias. n > 0.
  std::uint64_t below(std::uint64_t n);
  /// Standard normal (polar method of Marsaglia).
  double normal();

 private:
  std::array<std::uint64_t, 4> state_{};
};

}  // namespace indet
