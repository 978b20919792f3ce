#pragma once

#include <array>
#include <cstdint>

#include "libindet/lp/feasible_set.h"
#include "libindet/lp/vertex.h"

namespace indet {

/// Which of the better neighbours a walk goes to, and so on which of all optimal extremal points it ends
/// (docs/decisions/paper-walk.md).
enum class NeighbourRule : std::uint8_t {
  kFirst,  ///< the first, in the order of the list of active inequalities
  kBest,   ///< the best of all
  kRandom  ///< the first, in an order drawn anew at every extremal point
};
inline constexpr std::array kNeighbourRules = {NeighbourRule::kFirst, NeighbourRule::kBest,
                                               NeighbourRule::kRandom};
const char* to_string(NeighbourRule rule);  ///< "first", "best", "random".

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
/// edge of the polytope to a neighbour, where another inequality becomes active. "If any one of the
/// neighboring points is better, we move there": the list of active inequalities is gone through until a
/// neighbour is better, and the inequality that became active takes the place of the one that was relaxed.
/// The walk ends where none is better. Non-transmitting contacts are two active inequalities, like two
/// sliding contacts (Sec. II E).
///
/// Directions of the edges are columns of S_N⁻¹, which a step changes by a matrix of rank one (6 d²); each
/// edge that is followed costs one product (2 K d). A neighbour that lies where the objective does not grow
/// is seen to be no better from the slope along its edge, which is then not followed; the walk is the same.
/// The point is moved along edges, so rounding adds up, and nothing is done about points at which more than d
/// inequalities are active: failures are reported as they come.
class NeighbourSearch {
 public:
  /// `view` must outlive the search. `epsilon`: an inequality below it is active (force units). `seed`: of
  /// kRandom.
  NeighbourSearch(const SlopeView& view, double epsilon, NeighbourRule rule, std::uint64_t seed = 1);

  /// From a vertex to one that maximises the objective. Walks of one `number` draw the same random numbers.
  NeighbourWalk walk(const Objective& objective, const Basis& start, std::uint64_t number = 0) const;

 private:
  const SlopeView& view_;
  double epsilon_;
  NeighbourRule rule_;
  std::uint64_t seed_;
};

}  // namespace indet
