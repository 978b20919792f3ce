#include "libindet/barrier/lock_step.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "libindet/barrier/aligned_memory.h"
#include "libindet/barrier/block_cholesky.h"
#include "libindet/base/constants.h"
#include "libindet/base/lanes.h"
#include "libindet/base/tolerances.h"

namespace indet::barrier {
namespace {

using tolerance::kHugePivot;
using tolerance::kVanishingPivot;

/// Eight lanes in four registers of two doubles, which every 64-bit processor has; in two of four; in one of
/// eight.
namespace pairs {
using Register = double __attribute__((vector_size(16)));
constexpr int kRegisters = 4;
#include "libindet/barrier/kernels.inc"
#include "libindet/barrier/lock_step.inc"
}  // namespace pairs

#ifdef INDET_WIDER_LANES
#pragma GCC push_options
#pragma GCC target("avx2")
namespace fours {
using Register = double __attribute__((vector_size(32)));
constexpr int kRegisters = 2;
#include "libindet/barrier/kernels.inc"
#include "libindet/barrier/lock_step.inc"
}  // namespace fours
#pragma GCC pop_options

#pragma GCC push_options
#pragma GCC target("avx512f,avx512vl,avx512dq")
namespace eights {
using Register = double __attribute__((vector_size(64)));
constexpr int kRegisters = 1;
#include "libindet/barrier/kernels.inc"
#include "libindet/barrier/lock_step.inc"
}  // namespace eights
#pragma GCC pop_options
#endif

int widest_registers() {
#ifdef INDET_WIDER_LANES
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512dq"))
    return 512;
  if (__builtin_cpu_supports("avx2")) return 256;
#endif
  return 128;
}

}  // namespace

int vector_bits() {
  static const int bits = widest_registers();
  return bits;
}

void minimise_in_lock_step(const BlockStructure& structure, const AnalyticCentre& centre,
                           const LockStepOptions& options, const LockStepCalls& calls) {
#ifdef INDET_WIDER_LANES
  const int bits = std::min(options.vector_bits, vector_bits());
  if (bits >= 512) return eights::LockStep(structure, centre, options, calls).run();
  if (bits >= 256) return fours::LockStep(structure, centre, options, calls).run();
#endif
  pairs::LockStep(structure, centre, options, calls).run();
}

}  // namespace indet::barrier
