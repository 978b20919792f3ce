#pragma once

#include <string>
#include <vector>

#include "indet/ensemble/samples.h"

namespace indet {

/// One row of the table that sets the paper beside an ensemble.
struct Comparison {
  std::string quantity;
  std::string paper;
  std::string ours;     ///< With standard errors over the seeds.
  std::string verdict;  ///< "agrees", "differs", or "" where the paper gives no number.
};

/// The numbers of Sec. III of the paper, which are for N = 95, μ = 0.3, and ours. A number agrees if the two
/// differ by at most two standard errors of their difference; where the paper gives none, by 10 %.
std::vector<Comparison> compare_with_paper(const EnsembleTables& tables);

/// What the paper could not say: certificates, uniqueness, dimension against nullity, unbounded ranges.
std::vector<Comparison> beyond_the_paper(const EnsembleTables& tables);

}  // namespace indet
