#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "libindet/io/hdf5_file.h"
#include "libindet/io/sampling_file.h"
#include "libindet/packing/packing.h"
#include "libindet/range/force_ranges.h"
#include "libindet/sampling/bias.h"
#include "libindet/sampling/uniform_sampling.h"

namespace indet {

/// What uniform sampling found about one packing.
struct UniformResult {
  std::string outcome;                        ///< converged, limit; without a sample: unbounded, point, empty
  std::optional<SamplingRecord> record = {};  ///< As of indet sample --method uniform, without states.
  std::optional<SamplingBias> bias = {};      ///< Of `chain`.
};

/// Samples the polytope uniformly and compares with `chain`, the states of perturb-and-resolve in the order
/// in which they were found (2M × S; with fewer than 32 there is no comparison). The result does not
/// depend on the number of threads. Throws LibraryError, Interrupted.
UniformResult sample_uniformly(const Packing& packing, const ForceRanges& ranges, const WeightStates& chain,
                               const UniformOptions& options);

/// Writes /uniform and /bias (docs/file-format.md).
void write_uniform_part(Hdf5File& file, const UniformResult& result);

}  // namespace indet
