#pragma once

#include <string>

#include "apps/command.h"
#include "libindet/io/hdf5_file.h"
#include "libindet/packing/packing.h"
#include "libindet/sampling/uniform_sampling.h"

namespace indet::app {

struct UniformSettings {
  UniformOptions sampling;
  bool conditioned = false;  ///< the packing has bounds that are not the file's
  int states = 0;            ///< how many of the samples are written
  bool covariance = false;   ///< all covariances are written
  bool shape = false;        ///< size and shape of the polytope too
  int volume_sweeps = 1000;  ///< sweeps of each chain and phase for the volume
};

/// indet sample --method uniform. `file` is named in messages and searched for force ranges; `output` may be
/// empty.
int sample_uniformly(const Hdf5File& file, const std::string& output, const Packing& packing,
                     UniformSettings settings, const Context& context);

}  // namespace indet::app
