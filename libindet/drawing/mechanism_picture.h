#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "libindet/limit/mechanism.h"
#include "libindet/packing/packing.h"

namespace indet {

/// A picture of a virtual motion: disks that move are filled, with an arrow along the velocity of each, of a
/// length ∝ |v| (the largest is two mean radii long), and an arc where it turns; contacts that open are drawn
/// as a gap, those that slide as a double line, those that rest as a thin line. Loaded walls have arrows,
/// too. Format, legend and caption as of draw_forces.
void draw_mechanism(const std::filesystem::path& path, const Packing& packing,
                    const exact::BodyMotion& motion, const std::string& caption);

}  // namespace indet
