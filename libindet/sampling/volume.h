#pragma once

#include <cstdint>
#include <limits>

#include "libindet/base/progress.h"
#include "libindet/sampling/convex_body.h"
#include "libindet/sampling/uniform_sampling.h"

namespace indet {

/// The volume of a body K by annealed Gaussians (B. Cousins and S. Vempala, Math. Prog. Comp. 8, 133 (2016)).
/// In rounded coordinates, with Z(a) = ∫_K exp(−a ‖y‖²/2) dy,
///
///   vol K = Z(0) = Z(a_m) ∏_i Z(a_i)/Z(a_{i+1}),  0 = a_0 < a_1 < … < a_m,
///   Z(a_{i+1})/Z(a_i) = ⟨exp(−(a_{i+1} − a_i) ‖y‖²/2)⟩ over the density ∝ exp(−a_i ‖y‖²/2) on K,
///   Z(a_m) = (2π/a_m)^{n/2} P(y ∈ K), y normal with the variance 1/a_m,
///
/// where a_m is so large that at least half of the normal points fall into K, and are counted. Chains start
/// from uniform samples and follow the a_i, each of which is chosen so that the weights that lead to it have
/// a relative variance of 1/4.
struct VolumeOptions {
  int chains = 16;    ///< ≥ 2; the error is that of a jackknife over them
  int sweeps = 1000;  ///< of each chain at each a_i, ≥ 10
  std::uint64_t seed = 0;
  int threads = 1;  ///< the result does not depend on it
  ProgressCallback progress;
};

/// log is natural; the volume is in n-th powers of mg.
struct VolumeEstimate {
  double log_volume = std::numeric_limits<double>::quiet_NaN();
  double error = std::numeric_limits<double>::quiet_NaN();  ///< standard error of log_volume
  int phases = 0;
};

/// Preconditions: `sample` is a sample of `body`. Throws Interrupted, LibraryError if the a_i do not end.
VolumeEstimate estimate_volume(const ConvexBody& body, const UniformSample& sample,
                               const VolumeOptions& options);

}  // namespace indet
