#include "libsim/sweep.h"

#include <algorithm>

#ifdef INDET_WIDER_LANES
#include <immintrin.h>
#endif

namespace indet::sim {
namespace {

/// Two registers of two doubles.
namespace pairs {

using Four = FourLanes;

inline Four operator+(const Four& a, const Four& b) { return {a.low + b.low, a.high + b.high}; }
inline Four operator-(const Four& a, const Four& b) { return {a.low - b.low, a.high - b.high}; }
inline Four operator*(const Four& a, const Four& b) { return {a.low * b.low, a.high * b.high}; }
inline Four operator-(const Four& a) { return {-a.low, -a.high}; }
inline Four all(double value) { return {both(value), both(value)}; }
inline const Four& load(const FourLanes& lanes) { return lanes; }
inline void store(FourLanes& lanes, const Four& value) { lanes = value; }
inline Four larger(const Four& a, const Four& b) {
  return {indet::larger(a.low, b.low), indet::larger(a.high, b.high)};
}
inline Four smaller(const Four& a, const Four& b) {
  return {indet::smaller(a.low, b.low), indet::smaller(a.high, b.high)};
}
inline double largest(const Four& a) { return std::max({a[0], a[1], a[2], a[3]}); }

/// Velocity of a less that of b, and the sum of their surface speeds.
template <bool kFriction, bool kArms>
struct Motion {
  Four x, y, turn;
  Motion(const VelocityRow* rows, const ContactGroup& c) {
    const auto difference = [&](std::size_t i) { return rows[c.a[i]].v - rows[c.b[i]].v; };
    const Lanes u0 = difference(0), u1 = difference(1), u2 = difference(2), u3 = difference(3);
    x = {first_of(u0, u1), first_of(u2, u3)};
    y = {second_of(u0, u1), second_of(u2, u3)};
    if constexpr (!kFriction) return;
    const auto turns = [rows](const std::array<int, 4>& body) -> Four {
      return {first_of(rows[body[0]].s, rows[body[1]].s), first_of(rows[body[2]].s, rows[body[3]].s)};
    };
    turn = kArms ? c.arm_a * turns(c.a) + c.arm_b * turns(c.b) : turns(c.a) + turns(c.b);
  }
};

/// Adds to the rows of four bodies.
template <bool kFriction>
void push(VelocityRow* rows, const std::array<int, 4>& body, const Four& x, const Four& y, const Four& turn) {
  rows[body[0]].v += first_of(x.low, y.low);
  rows[body[1]].v += second_of(x.low, y.low);
  rows[body[2]].v += first_of(x.high, y.high);
  rows[body[3]].v += second_of(x.high, y.high);
  if constexpr (!kFriction) return;
  for (std::size_t i = 0; i < 4; ++i) rows[body[i]].s[0] += turn[i];
}

#include "libsim/sweep_lanes.inc"

}  // namespace pairs

#ifdef INDET_WIDER_LANES
#pragma GCC push_options
#pragma GCC target("avx2")
/// One register of four doubles.
namespace fours {

using Four = __m256d;

inline Four all(double value) { return _mm256_set1_pd(value); }
inline Four load(const FourLanes& lanes) { return _mm256_load_pd(reinterpret_cast<const double*>(&lanes)); }
inline void store(FourLanes& lanes, Four value) { _mm256_store_pd(reinterpret_cast<double*>(&lanes), value); }
inline Four larger(Four a, Four b) { return _mm256_max_pd(a, b); }
inline Four smaller(Four a, Four b) { return _mm256_min_pd(a, b); }
inline double largest(Four a) { return std::max({a[0], a[1], a[2], a[3]}); }
inline Four row(const VelocityRow& r) { return _mm256_load_pd(reinterpret_cast<const double*>(&r)); }
inline Four low_halves(Four a, Four b) { return _mm256_insertf128_pd(a, _mm256_castpd256_pd128(b), 1); }
inline Four high_halves(Four a, Four b) { return _mm256_permute2f128_pd(a, b, 0x31); }

template <bool kFriction, bool kArms>
struct Motion {
  Four x, y, turn;
  Motion(const VelocityRow* rows, const ContactGroup& c) {
    const Four a0 = row(rows[c.a[0]]), a1 = row(rows[c.a[1]]), a2 = row(rows[c.a[2]]), a3 = row(rows[c.a[3]]);
    const Four b0 = row(rows[c.b[0]]), b1 = row(rows[c.b[1]]), b2 = row(rows[c.b[2]]), b3 = row(rows[c.b[3]]);
    const Four u0 = a0 - b0, u1 = a1 - b1, u2 = a2 - b2, u3 = a3 - b3;
    x = low_halves(_mm256_unpacklo_pd(u0, u1), _mm256_unpacklo_pd(u2, u3));
    y = low_halves(_mm256_unpackhi_pd(u0, u1), _mm256_unpackhi_pd(u2, u3));
    if constexpr (!kFriction) return;
    if constexpr (kArms) {
      turn = load(c.arm_a) * high_halves(_mm256_unpacklo_pd(a0, a1), _mm256_unpacklo_pd(a2, a3)) +
             load(c.arm_b) * high_halves(_mm256_unpacklo_pd(b0, b1), _mm256_unpacklo_pd(b2, b3));
    } else {
      turn = high_halves(_mm256_unpacklo_pd(a0 + b0, a1 + b1), _mm256_unpacklo_pd(a2 + b2, a3 + b3));
    }
  }
};

template <bool kFriction>
void push(VelocityRow* rows, const std::array<int, 4>& body, Four x, Four y, Four turn) {
  const Four even = _mm256_unpacklo_pd(x, y);
  const Four odd = _mm256_unpackhi_pd(x, y);
  const Four turn_even = _mm256_unpacklo_pd(turn, _mm256_setzero_pd());
  const Four turn_odd = _mm256_unpackhi_pd(turn, _mm256_setzero_pd());
  const auto add = [ rows, &body ](std::size_t i, Four step) __attribute__((always_inline)) {
    double* target = reinterpret_cast<double*>(&rows[body[i]]);
    _mm256_store_pd(target, _mm256_load_pd(target) + step);
  };
  add(0, low_halves(even, turn_even));
  add(1, low_halves(odd, turn_odd));
  add(2, high_halves(even, turn_even));
  add(3, high_halves(odd, turn_odd));
}

#include "libsim/sweep_lanes.inc"

}  // namespace fours
#pragma GCC pop_options
#endif

}  // namespace

double sweep_in_pairs(SweepParts parts, std::span<ContactGroup> groups, std::span<VelocityRow> rows) {
  return pairs::sweep(parts, groups, rows.data());
}

double sweep(SweepParts parts, std::span<ContactGroup> groups, std::span<VelocityRow> rows) {
#ifdef INDET_WIDER_LANES
  static const bool has_fours = __builtin_cpu_supports("avx2") != 0;
  if (has_fours) return fours::sweep(parts, groups, rows.data());
#endif
  return sweep_in_pairs(parts, groups, rows);
}

}  // namespace indet::sim
