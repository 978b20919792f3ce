#pragma once

#include <cstdint>

#include "libindet/lp/feasible_set.h"
#include "libindet/lp/vertex.h"

namespace indet {

/// How a walk over extremal points ended.
enum class WalkEnd : std::uint8_t {
  kNoneBetter,      ///< exactly d active inequalities, and no neighbour is better: success
  kMoreActive,      ///< no neighbour is better, but more than d inequalities are active: polytope edges
                    ///< may have no length
  kFewerActive,     ///< an inequality that should be active has drifted away by more than ε
  kDirectionsLost,  ///< the active inequalities are dependent to rounding: no directions of polytope edges
  kPolytopeEdgeWithoutEnd,  ///< a better neighbour would lie at infinity
  kStepLimit
};
inline constexpr int kWalkEnds = 6;
const char* to_string(WalkEnd end);

struct NeighbourWalk {
  WalkEnd end = WalkEnd::kStepLimit;
  Basis basis;                  ///< where it ended
  std::int64_t steps = 0;       ///< moves to a neighbour
  std::int64_t neighbours = 0;  ///< neighbours that were looked at
  std::int64_t unexpected = 0;  ///< of the extremal points passed, those with more than d active inequalities
};

/// The paper's search (Sec. II G): at an extremal point each of the d active inequalities is relaxed in turn.
/// The one direction that respects the other d − 1 is built from the active constraints; it leads along an
/// edge of the polytope to a neighbour, where another inequality becomes active. The walk goes to the best
/// neighbour, until none is better. Non-transmitting contacts are two active inequalities, like two sliding
/// contacts (Sec. II E).
///
/// Directions of all these edges are the columns of S_N⁻¹, so a step is one inversion (d³) and one product (K
/// d²). The slope of the objective along an edge would tell beforehand which neighbours are worse; that
/// thought is the simplex method's (tableau_solver.h), and the paper looks at all of them. As there, the
/// point is moved along edges, so rounding adds up, and nothing is done about points at which more than d
/// inequalities are active: failures are reported as they come.
class NeighbourSearch {
 public:
  /// `set` must outlive the search. `epsilon`: an inequality below it is active (force units).
  NeighbourSearch(const SlopeView& view, double epsilon);

  /// From a vertex to one that maximises the objective.
  NeighbourWalk walk(const Objective& objective, const Basis& start) const;

 private:
  const SlopeView& view_;
  double epsilon_;
};

}  // namespace indet
