#pragma once

#include <vector>

#include "libindet/exact/body_motion.h"
#include "libindet/exact/optimum.h"
#include "libindet/limit/load_limits.h"
#include "libindet/packing/packing.h"

namespace indet {

/// Whether a packing stands under its loads, proven in rational arithmetic.
struct Standing {
  /// kOptimal: it does. kEmpty, kInconsistent: it does not. kUndecided.
  exact::Verdict verdict = exact::Verdict::kUndecided;
  SceneForces forces;        ///< if it stands: a vertex of F
  exact::BodyMotion motion;  ///< if it does not: a motion that nothing resists and under which the load works

  bool stands() const { return verdict == exact::Verdict::kOptimal; }
  bool falls() const { return verdict == exact::Verdict::kEmpty || verdict == exact::Verdict::kInconsistent; }
};

/// Precondition: find_defect(packing) is empty.
Standing find_standing(const Packing& packing, const LimitOptions& options = {});

}  // namespace indet
