#pragma once

#include <array>
#include <cstdint>

#include "libindet/pivoting/interior_start.h"
#include "libindet/pivoting/neighbour_search.h"

namespace indet {

/// What the paper's method (Method::kPivotingPaper) did and where it failed, by its own account.
struct PaperWork {
  std::array<std::int64_t, kInteriorEnds> starts{};  ///< blocks by InteriorEnd; those not kFound start from a
                                                     ///< linear program's interior point
  std::int64_t sliding_left = 0;                     ///< active constraints left on the way to the interior
  std::array<std::int64_t, kWalkEnds> walks{};       ///< objectives by WalkEnd
  std::int64_t points = 0;                           ///< extremal points passed
  std::int64_t unexpected = 0;  ///< of these, points with more active constraints than dimensions
  std::int64_t neighbours = 0;  ///< neighbours looked at

  PaperWork& operator+=(const PaperWork& other);
  std::int64_t walk_count() const;
  /// Walks that did not end with exactly as many active constraints as dimensions and no better neighbour.
  std::int64_t failures() const;
  /// Blocks that started from a linear program's interior point.
  std::int64_t fallbacks() const;
};

}  // namespace indet
