#pragma once

#include "libindet/range/analyze.h"

namespace indet {

inline constexpr Formulation kFormulations[] = {Formulation::kNullSpace, Formulation::kDual,
                                                Formulation::kEdge};

inline ForceRanges analyze_by(Formulation formulation, const Packing& packing, int threads = 1) {
  AnalyzeOptions options;
  options.formulation = formulation;
  options.threads = threads;
  return analyze(packing, options);
}

}  // namespace indet
