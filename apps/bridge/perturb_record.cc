#include "apps/bridge/perturb_record.h"

namespace indet {

SamplingRecord record_of(const sim::PerturbEnsemble& ensemble, const sim::PerturbOptions& options) {
  SamplingRecord record;
  record.method = "perturb";
  record.center = ensemble.center;
  record.numbers = {{"r", ensemble.r},
                    {"r_error", ensemble.r_error},
                    {"spread", ensemble.spread},
                    {"start_distance", ensemble.start_distance},
                    {"samples", static_cast<double>(ensemble.samples.size())},
                    {"accepted", ensemble.accepted},
                    {"converged", ensemble.converged},
                    {"worst_raw_residual", ensemble.worst_raw_residual},
                    {"worst_residual", ensemble.worst_residual},
                    {"chains", options.chains},
                    {"width", options.width},
                    {"seed", static_cast<double>(options.seed)}};
  return record;
}

}  // namespace indet
