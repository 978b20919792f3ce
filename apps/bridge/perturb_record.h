#pragma once

#include "libindet/io/sampling_file.h"
#include "libsim/perturb_sampling.h"

namespace indet {

/// The record of perturb-and-resolve, as in the files of indet sample.
SamplingRecord record_of(const sim::PerturbEnsemble& ensemble, const sim::PerturbOptions& options);

}  // namespace indet
