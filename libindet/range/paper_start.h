#pragma once

#include "libindet/lp/feasible_set.h"
#include "libindet/lp/lp_solver.h"
#include "libindet/packing/force.h"
#include "libindet/polytope/force_polytope.h"
#include "libindet/range/paper_work.h"

namespace indet {

/// The first extremal point of the paper's method (Sec. II G) in a block of the polytope: from the simulated
/// state into the interior, sliding contact by sliding contact, then along vectors of the null space until as
/// many inequalities are active as there are dimensions. Where the interior is not found in this way, a
/// linear program finds it (`options`); `work` counts both. Throws LibraryError if that fails too.
Basis first_extremal_point(const SceneForces& simulated, const ForcePolytope& polytope,
                           const PolytopeBlock& block, const LpOptions& options, PaperWork& work);

}  // namespace indet
