#pragma once

#include <string>
#include <vector>

#include "apps/ensemble/tables/ensemble_tables.h"
#include "apps/ensemble/tables/figure.h"

namespace indet {

/// How far the packings of each protocol are from yielding; none if no limits were found.
std::vector<Figure> limit_figures(const EnsembleTables& tables);

/// The same as a table: a quantity a row, a protocol a column, then the difference of CD and MD, and which of
/// them is more stable by two of its standard errors. The first row names the columns.
std::vector<std::vector<std::string>> limit_summary(const EnsembleTables& tables);

}  // namespace indet
