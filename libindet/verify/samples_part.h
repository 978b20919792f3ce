#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <string>

#include "libindet/base/tolerances.h"
#include "libindet/io/sampling_file.h"
#include "libindet/packing/packing.h"
#include "libindet/range/force_ranges.h"
#include "libindet/verify/comparisons.h"
#include "libindet/verify/rebuilt_problem.h"

namespace indet {

/// What the checks of one group of samples share. Forces in mg.
struct SamplesPart {
  const Packing& packing;
  const SamplingRecord& record;
  const ForceRanges* ranges;  ///< may be null
  const RebuiltProblem& problem;
  Comparisons& compare;
  Eigen::VectorXd center = record.center / problem.force_unit();
  double scale =
      std::max(problem.internal_unit(), center.size() > 0 ? center.lpNorm<Eigen::Infinity>()
                                                          : 0.0);  ///< that tolerances are relative to

  /// The simulated forces; NaN where they are not known.
  Eigen::VectorXd start() const { return packing.simulated_forces().value() / problem.force_unit(); }
  /// ε, below which a force counts as nothing, and one that varies less as determined.
  double epsilon() const { return tolerance::kSliding * problem.internal_unit(); }

  bool has(const std::string& name) const { return record.numbers.contains(name); }
  /// NaN if it is not stored.
  double number(const std::string& name) const {
    const auto found = record.numbers.find(name);
    return found == record.numbers.end() ? Verification::kNaN : found->second;
  }
  void require_in(const std::string& name, double low, double high) const {
    const double value = number(name);
    compare.require(low <= value && value <= high, "{}: {} is not within {} … {}", name, value, low, high);
  }
  /// A whole number of at least `least`; NaN, and a contradiction, if it is not.
  double count(const std::string& name, double least = 0) const {
    const double value = number(name);
    const bool is_count = value >= least && value == std::floor(value) && value < 1e15;
    return compare.require(is_count, "{}: {} is not a number of at least {}", name, value, least)
               ? value
               : Verification::kNaN;
  }
};

/// Numbers of a uniform sample that follow from the packing, the centre and each other.
void check_uniform_numbers(const SamplesPart& part);

/// Tables of a uniform sample: R̂, effective sizes, σ, quantiles, covariances, stored states.
void check_components(const SamplesPart& part);

/// Every number of a uniform sample of which the file holds all states.
void check_whole_sample(const SamplesPart& part);

/// True if the file holds all states of the sample.
bool has_whole_sample(const SamplesPart& part);

}  // namespace indet
