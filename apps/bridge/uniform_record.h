#pragma once

#include <map>
#include <string>

#include "libindet/io/sampling_file.h"
#include "libindet/polytope/force_polytope.h"
#include "libindet/sampling/placement.h"
#include "libindet/sampling/uniform_sampling.h"

namespace indet {

/// A uniform sample as the numbers (in mg) and tables (in the scene's unit) of a file (docs/file-format.md).
std::map<std::string, double> numbers_of(const ForcePolytope& polytope, const UniformSample& sample,
                                         const UniformOptions& options);
/// The same for a polytope that is a point.
std::map<std::string, double> numbers_of_point(const UniformSample& sample, const ForceUnits& units,
                                               const UniformOptions& options);
/// Where the simulated state lies; without the place in the ranges where these are not known.
std::map<std::string, double> numbers_of(const Placement& placement);

/// Without states.
ComponentRecord components_of(const ConvexBody& body, const UniformSample& sample);

/// `count` of the samples, evenly spread: 2M × count.
InternalStates some_states(const ConvexBody& body, const UniformSample& sample, int count);

/// The one state of a polytope that is a point.
UniformSample sample_of_point(const ForcePolytope& polytope);

}  // namespace indet
