#pragma once

#include <vector>

#include "apps/ensemble/tables/ensemble_tables.h"
#include "apps/ensemble/tables/figure.h"

namespace indet {

/// Figures 3, 6a, 6b and 7–13 of the paper from the tables of an ensemble; figures whose protocols are not
/// there are left out. Errors are bootstraps over seeds.
std::vector<Figure> make_figures(const EnsembleTables& tables);

}  // namespace indet
