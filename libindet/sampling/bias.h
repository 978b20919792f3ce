#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "libindet/base/progress.h"
#include "libindet/range/force_ranges.h"
#include "libindet/sampling/convex_body.h"
#include "libindet/sampling/uniform_sampling.h"
#include "libindet/statistics/two_sample.h"

namespace indet {

/// How often values lie in [k width, (k + 1) width), k = first, first + 1, …
struct BinnedValues {
  double width = 1;
  int first = 0;
  std::vector<std::int32_t> counts = {};

  void add(double value);
};

/// Normal forces of all contacts in all states of a sample.
struct SampledForces {
  BinnedValues force{.width = 1};        ///< R in mg
  BinnedValues standard{.width = 0.25};  ///< (R − ⟨R⟩)/σ_R of the contact, both of the uniform distribution
  BinnedValues place{.width = 0.05};  ///< R* [39]; empty without ranges
};

/// How another sample of the contact states of a packing, a Markov chain, differs from the uniform
/// distribution. Forces and distances are in mg. The number of states is replaced by effective ones
/// in every error. Tests are of the normal forces, one a contact; NaN where R is determined, or where the
/// chain is worth fewer than `kFewest` states of that contact.
struct SamplingBias {
  static constexpr double kFewest = 20;  ///< below, effective sizes are too uncertain for p-values
  static constexpr double kRate = 0.05;  ///< of false discoveries

  int states = 0;            ///< of the chain
  double r = -1;             ///< its radius [38]
  double r_error = -1;       ///< its standard error
  double ratio = -1;         ///< r/r_uniform
  double ratio_error = -1;   ///< its standard error
  double center_shift = -1;  ///< ‖⟨F⟩ − F°‖: (‖difference‖² − center_noise²)^½, or 0
  double center_shift_error = -1;  ///< standard error of the difference along its direction
  double center_noise = -1;        ///< root of the sum of the squared standard errors of all components

  Eigen::VectorXd mean, deviation;     ///< M: of the R of the chain
  Eigen::VectorXd effective;           ///< M: effective states of the chain for the mean of R
  Eigen::VectorXd uniform_effective;   ///< M: the same of the uniform sample
  std::vector<TwoSampleTest> tests;    ///< M: the chain against the uniform sample
  std::vector<TwoSampleTest> control;  ///< M: half of the uniform chains against the other half
  SampledForces uniform, chain;

  int tested = 0;         ///< contacts with a test
  int means = 0;          ///< contacts whose means differ, at kRate
  int distributions = 0;  ///< contacts whose distributions differ, at kRate
  int control_means = 0, control_distributions = 0;
};

/// `chain`: 2M × S, one state after the other. `ranges`: of the same packing, or null.
/// Precondition: S ≥ 16; the sample has at least four chains, of which it uses an even number for the
/// control.
SamplingBias compare_with_uniform(const ConvexBody& body, const UniformSample& sample,
                                  const WeightStates& chain, const ForceRanges* ranges);

}  // namespace indet
