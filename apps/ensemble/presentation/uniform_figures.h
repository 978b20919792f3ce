#pragma once

#include <string>
#include <vector>

#include "apps/ensemble/tables/ensemble_tables.h"
#include "apps/ensemble/tables/figure.h"

namespace indet {

/// What uniform sampling says about perturb-and-resolve and about the simulated states; none if no packing
/// was sampled uniformly.
std::vector<Figure> uniform_figures(const EnsembleTables& tables);

/// The same as a table: a quantity a row, a protocol a column, and what the value would be if both samplings
/// were the same, or if all states were equally likely. The first row names the columns.
std::vector<std::vector<std::string>> uniform_summary(const EnsembleTables& tables);

}  // namespace indet
