#pragma once

#include <Eigen/Core>

#include "libindet/packing/packing.h"
#include "libindet/range/force_ranges.h"
#include "libindet/sampling/convex_body.h"
#include "libindet/sampling/uniform_sampling.h"

namespace indet {

/// Where one contact state, the simulated one, lies within a uniform sample. If every state were equally
/// likely to come about, each percentile would be uniform in [0, 100] over many packings, and nine tenths of
/// the contacts would have forces in the central nine tenths of their distributions.
///
/// A percentile is the percentage of samples whose value is smaller; where many samples have the same value
/// as the state (numbers of sliding contacts), half of those count too. NaN where a force is not known.
struct Placement {
  double distance = -1;                 ///< ‖F − F°‖ of the state, mg
  double distance_percentile = -1;      ///< of that distance among those of the samples
  double norm_percentile = -1;          ///< of ‖F‖
  double normal_force_percentile = -1;  ///< of ΣR
  double mobilisation_percentile = -1;  ///< of the mean of |T|/(μR) over contacts with friction and R > 0
  double central_fraction_R = -1;       ///< contacts whose R lies between the 5 % and the 95 % quantile
  int sliding = -1;                     ///< M_s of the state
  int most_sliding = -1;                ///< the largest M_s of a sample; ε as in the paper
  double sliding_percentile = -1;       ///< of M_s
  double mean_R_star = -1;              ///< of the state [39]; NaN without ranges
  double R_star_percentile = -1;        ///< of that mean; NaN without ranges
  Eigen::VectorXd percentile_R;         ///< M: of each R; NaN where it is determined
};

/// `ranges`: may be null.
Placement place_state(const Packing& packing, const ConvexBody& body, const UniformSample& sample,
                      const SceneForces& state, const ForceRanges* ranges);

}  // namespace indet
