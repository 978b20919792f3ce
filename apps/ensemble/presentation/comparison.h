#pragma once

#include <string>
#include <vector>

#include "apps/ensemble/presentation/samples.h"

namespace indet {

/// One row of the table that sets the paper beside an ensemble.
struct Comparison {
  std::string quantity;
  std::string paper;
  std::string ours;     ///< With standard errors over the seeds.
  std::string verdict;  ///< verdict.h; "" on an ensemble of other packings.
};

/// The numbers of Sec. III of the paper, which are for N = 95, μ = 0.3, and ours. A number agrees if the two
/// differ by at most two standard errors of their difference; where the paper gives none, by 10 %. There is
/// no verdict on an ensemble of other packings.
std::vector<Comparison> compare_with_paper(const EnsembleTables& tables);

/// Why numbers of these packings cannot agree or differ: some N is not 95 or some μ is not 0.3. Empty if all
/// are as in the paper.
std::string reason_for_no_verdict(const EnsembleTables& tables);

/// What the paper could not say: certificates, uniqueness, dimension against nullity, unbounded ranges.
std::vector<Comparison> beyond_the_paper(const EnsembleTables& tables);

}  // namespace indet
