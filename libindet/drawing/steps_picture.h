#pragma once

#include <filesystem>
#include <string>

#include "libindet/limit/limit.h"

namespace indet {

/// A picture of how the polytope F of admissible states shrinks on the way to a limit: mean δR, the radius of
/// the uniform distribution, the mean width, and the radius of the largest ball in F, each relative to what
/// it is at the first step, against the angle, the multiple or the factor. What is 0 or infinite there, or
/// not known, is left out. Format as of draw_forces. Precondition: the end has steps.
void draw_steps(const std::filesystem::path& path, const Limit& limit, const LimitEnd& end,
                const std::string& caption);

}  // namespace indet
