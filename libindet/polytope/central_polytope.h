#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "libindet/barrier/analytic_centre.h"
#include "libindet/barrier/block_structure.h"
#include "libindet/barrier/verified_equations.h"
#include "libindet/equilibrium/equilibrium_problem.h"
#include "libindet/packing/packing.h"
#include "libindet/polytope/force_polytope.h"

namespace indet {

/// The analytic centre of a bounded polytope that is full-dimensional in the edges of its problem, and what
/// it proves: all that the barrier method works on. No matrix in it is dense. Of an unbounded one it is the
/// centre of the part that `limit` leaves.
struct CentralPolytope {
  /// `rows`: independent equations of the problem that the others follow from.
  CentralPolytope(const EquilibriumProblem& problem, std::span<const int> rows, barrier::Limit limit = {});
  CentralPolytope(const CentralPolytope&) = delete;
  CentralPolytope& operator=(const CentralPolytope&) = delete;

  /// The centre is found and proven: the rows are independent, and the polytope is bounded and has an
  /// interior.
  bool is_proven() const { return equations && equations->is_proven(); }

  std::vector<int> rows;  ///< as given
  barrier::BlockStructure structure;
  barrier::AnalyticCentre centre;
  std::optional<barrier::VerifiedEquations> equations;
};

/// The polytope of a packing without any dense matrix, where this way proves what it is: bounded or a point,
/// with its centre; unbounded, with a ray; empty, with a motion. Nothing where it does not, and
/// find_force_polytope has to decide. Precondition: find_defect(packing) is empty.
std::optional<ForcePolytope> find_sparse_polytope(const Packing& packing);

/// Adds the centre to a polytope that find_force_polytope has found. Returns whether it is there: F is
/// bounded, and the centre proven.
bool add_centre(ForcePolytope& polytope);

}  // namespace indet
