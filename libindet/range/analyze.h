#pragma once

#include <optional>

#include "indet/base/progress.h"
#include "indet/lp/lp_solver.h"
#include "indet/packing/packing.h"
#include "indet/range/force_ranges.h"

namespace indet {

struct AnalyzeOptions {
  std::optional<Formulation> formulation;  ///< nothing: chosen by size (docs/decisions/formulation.md)
  LpOptions lp;
  bool canonical_states =
      true;         ///< extremal states of smallest total normal force; false: where the solver lands
  int threads = 1;  ///< the results do not depend on it
  ProgressCallback progress;
};

/// The ranges of all contact forces of a packing: from equilibrium problem to measures, each value with its
/// residuals. Precondition: find_defect(packing) is empty. Throws Interrupted, LibraryError.
ForceRanges analyze(const Packing& packing, const AnalyzeOptions& options = {});

/// The formulation that is fastest for a block of this dimension (docs/decisions/formulation.md).
Formulation choose_formulation(int dim);

}  // namespace indet
