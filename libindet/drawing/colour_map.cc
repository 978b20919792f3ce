#include "libindet/drawing/colour_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace indet {
namespace {

/// viridis (S. van der Walt, N. Smith; CC0) at steps of 1/10, from light to dark.
constexpr std::array<std::uint32_t, 11> kViridis = {0xfde725, 0xbddf26, 0x7ad151, 0x44bf70,
                                                    0x22a884, 0x21918c, 0x2a788e, 0x355f8d,
                                                    0x414487, 0x482475, 0x440154};

Colour from_hex(std::uint32_t hex) {
  return {(hex >> 16 & 255) / 255.0, (hex >> 8 & 255) / 255.0, (hex & 255) / 255.0};
}

}  // namespace

Colour map_colour(double fraction) {
  const double place = std::clamp(fraction, 0.0, 1.0) * (kViridis.size() - 1);
  const std::size_t index = std::min(static_cast<std::size_t>(place), kViridis.size() - 2);
  const double t = place - static_cast<double>(index);
  const Colour a = from_hex(kViridis[index]);
  const Colour b = from_hex(kViridis[index + 1]);
  return {std::lerp(a.red, b.red, t), std::lerp(a.green, b.green, t), std::lerp(a.blue, b.blue, t)};
}

}  // namespace indet
