#pragma once

#include <cstdint>

#include "libindet/base/random.h"

namespace indet {

/// What a chain of random numbers is for.
enum class ChainKind : std::uint64_t { kRounding = 1, kStart, kUniform, kVolume, kWidth };

/// The streams of random numbers of a seed are shared out so that no two chains have the same.
/// Precondition: 0 ≤ chain < 2³².
inline Random random_of(std::uint64_t seed, ChainKind kind, std::int64_t chain) {
  return Random(seed, (static_cast<std::uint64_t>(kind) << 32) + static_cast<std::uint64_t>(chain));
}

}  // namespace indet
