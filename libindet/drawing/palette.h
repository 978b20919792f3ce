#pragma once

#include "libindet/drawing/colour_map.h"

/// The colours of pictures of packings.
namespace indet::palette {

inline constexpr Colour kBlack{0.1, 0.1, 0.1};
inline constexpr Colour kDiskFill{0.93, 0.93, 0.93};
inline constexpr Colour kDiskOutline{0.62, 0.62, 0.62};
inline constexpr Colour kWallFill{0.80, 0.80, 0.80};
inline constexpr Colour kLoad{0, 0.5, 0.35};
inline constexpr Colour kCell{0.35, 0.2, 0.55};
inline constexpr Colour kUnknown{0.5, 0.5, 0.5};
// Okabe and Ito's vermilion and blue, which colour-blind people tell apart.
inline constexpr Colour kPositive{0.835, 0.369, 0};
inline constexpr Colour kNegative{0, 0.447, 0.698};
inline constexpr Colour kUnbounded{0.8, 0, 0.2};

}  // namespace indet::palette
