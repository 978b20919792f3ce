#pragma once

#include <array>
#include <cstdint>

#include "libindet/pivoting/neighbour_search.h"

namespace indet {

/// Where a walk of the paper's method starts.
enum class WalkStart : std::uint8_t {
  kCommon,  ///< every walk from the first extremal point (paper_start.h)
  kMinimum  ///< minima from there, the maximum of a component from its minimum
};
inline constexpr std::array kWalkStarts = {WalkStart::kCommon, WalkStart::kMinimum};
const char* to_string(WalkStart start);  ///< "common", "minimum".

/// What the paper leaves to the reader of its Sec. II G. Values are the same for all; which of many extremal
/// states is found, and so dR and dT, hangs on it (docs/decisions/paper-walk.md).
struct PaperOptions {
  NeighbourRule neighbour = NeighbourRule::kFirst;
  WalkStart start = WalkStart::kCommon;
  std::int64_t seed = 1;  ///< of NeighbourRule::kRandom
};

}  // namespace indet
