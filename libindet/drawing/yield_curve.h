#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "libindet/limit/limit.h"

namespace indet {

/// A picture of the plane of two loads: the points λ (cos φ, sin φ) at which a packing yields, joined by
/// lines, and the packing as it is at the origin. Where two directions in turn have no limit, the curve is
/// open; of one beside a direction with a limit, a dashed line leads out of the picture. Format as of
/// draw_forces. Precondition: each limit has a map_angle, and some end is reached.
void draw_yield_curve(const std::filesystem::path& path, const std::vector<Limit>& limits,
                      const std::string& caption);

}  // namespace indet
