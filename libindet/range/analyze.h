#pragma once

#include "libindet/packing/packing.h"
#include "libindet/range/analyze_options.h"
#include "libindet/range/force_ranges.h"

namespace indet {

/// The ranges of all contact forces of a packing: from equilibrium problem to measures, each value with its
/// residuals. Precondition: find_defect(packing) is empty. Throws InputError if the choice of states has a
/// defect, if kBarrier is to keep those of a solver, or if estimates are wanted of a polytope that has no
/// analytic centre, because it is unbounded or too thin, or of one that rounding decides about; Interrupted,
/// LibraryError.
ForceRanges analyze(const Packing& packing, const AnalyzeOptions& options = {});

/// The formulation that is fastest for a block of this dimension (docs/decisions/formulation.md).
Formulation choose_formulation(int dim);

}  // namespace indet
