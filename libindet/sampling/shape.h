#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "libindet/base/progress.h"
#include "libindet/lp/lp_solver.h"
#include "libindet/range/force_ranges.h"
#include "libindet/sampling/convex_body.h"
#include "libindet/sampling/uniform_sampling.h"

namespace indet {

/// How large the polytope F is, in mg.
///
/// With the support function h(u) = max_F u·F, the width of F along a unit vector u of its affine hull is
/// w(u) = h(u) + h(−u): two linear programs. Along the n principal axes of a uniform sample the widths give a
/// box that contains F, whose diagonal bounds the diameter from above; so does the diagonal of the box of the
/// ranges, (Σ δR² + δT²)^½. Two states of F bound it from below. Linear programs are solved to 1e-10; where
/// none of LpSolver's ways solves one, the numbers that need it are NaN.
struct PolytopeShape {
  double inscribed_radius = -1;    ///< of the largest ball in F (Chebyshev radius)
  double diameter_lower = -1;      ///< the largest distance of two states that are known
  double diameter_upper = -1;      ///< the smaller of both bounds
  double diameter_by_ranges = -1;  ///< (Σ δR² + δT²)^½; NaN without ranges
  double mean_width = -1;          ///< mean of w over directions u, all equally likely
  double mean_width_error = -1;    ///< its standard error over the directions that were drawn
  int unsolved = 0;                ///< linear programs that could not be solved
};

struct ShapeOptions {
  int directions = 48;  ///< random directions for the mean width, ≥ 2
  std::uint64_t seed = 0;
  LpOptions lp;
  ProgressCallback progress;
};

/// `ranges`: of the same packing, with its extremal states; may be null. Throws Interrupted.
PolytopeShape measure_shape(const ConvexBody& body, const UniformSample& sample, const ForceRanges* ranges,
                            const ShapeOptions& options = {});

}  // namespace indet
