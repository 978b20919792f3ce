#pragma once

#include <string>
#include <vector>

#include "apps/ensemble/presentation/comparison.h"
#include "apps/ensemble/tables/ensemble_tables.h"

namespace indet {

/// "656 of 658 known to 0.1 %, 2 imprecise, 0 failed", of the smallest distances that were asked for; "" if
/// none was.
std::string known_smallest_distances(const EnsembleTables& tables);

/// Adds what they are beside dR and dT with each choice of states: the means, and the ratio to those with
/// canonical states. Nothing if none was asked for.
void add_smallest_distances(const EnsembleTables& tables, std::vector<Comparison>& rows);

}  // namespace indet
