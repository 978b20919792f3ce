#pragma once

namespace indet {

/// Red, green and blue in [0, 1].
struct Colour {
  double red = 0, green = 0, blue = 0;
};

/// The viridis map from its light end (0) to its dark end (1): perceptually uniform, monotone in lightness,
/// and so readable in grey and by colour-blind people. Small values recede on white paper. `fraction` is
/// clamped.
Colour map_colour(double fraction);

}  // namespace indet
