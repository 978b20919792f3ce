#pragma once

#include <vector>

#include "apps/ensemble/presentation/comparison.h"
#include "apps/ensemble/presentation/samples.h"

namespace indet {

/// Adds a row for each protocol's number of sliding contacts (Fig. 6b), of the raw and of the polished state.
/// The paper, which does not polish, counts those of the raw state; the verdict is on them.
void add_sliding_contacts(const Samples& samples, std::vector<Comparison>& rows);

/// Adds rows for what the paper says of the densities that it draws (Figs. 7 and 9 to 13), each as one number
/// that can agree or differ.
void add_densities(const Samples& samples, std::vector<Comparison>& rows);

}  // namespace indet
