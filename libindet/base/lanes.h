#pragma once

#include <cmath>
#ifdef __SSE2__
#include <emmintrin.h>
#endif
// Where a part of a file can be compiled for wider registers: `#pragma GCC target`, which Clang does not
// know. Whether the processor has them is asked when the program runs.
#if defined(__x86_64__) && !defined(__clang__)
#define INDET_WIDER_LANES
#endif

namespace indet {

/// Two doubles that are worked on at once. Every operation acts on each lane by itself and rounds as IEEE 754
/// says, so that results are those of plain doubles, on any machine; where there are no such registers the
/// compiler works on one lane after the other.
using Lanes = double __attribute__((vector_size(16)));
/// What comparing Lanes gives: all bits of a lane set, or none.
using LaneMask = decltype(Lanes{} < Lanes{});

inline Lanes both(double value) { return Lanes{value, value}; }

inline Lanes root(Lanes v) {
#ifdef __SSE2__
  return _mm_sqrt_pd(v);
#else
  return Lanes{std::sqrt(v[0]), std::sqrt(v[1])};
#endif
}

/// a where a > b, else b.
inline Lanes larger(Lanes a, Lanes b) {
#ifdef __SSE2__
  return _mm_max_pd(a, b);
#else
  return a > b ? a : b;
#endif
}

/// a where a < b, else b.
inline Lanes smaller(Lanes a, Lanes b) {
#ifdef __SSE2__
  return _mm_min_pd(a, b);
#else
  return a < b ? a : b;
#endif
}

/// The value where the mask is set, else +0.
inline Lanes where(LaneMask mask, Lanes value) {
  return reinterpret_cast<Lanes>(mask & reinterpret_cast<LaneMask>(value));
}

/// (a_0, b_0) and (a_1, b_1): turns vectors of two pairs into the components of both, and back.
inline Lanes first_of(Lanes a, Lanes b) { return __builtin_shufflevector(a, b, 0, 2); }
inline Lanes second_of(Lanes a, Lanes b) { return __builtin_shufflevector(a, b, 1, 3); }

}  // namespace indet
