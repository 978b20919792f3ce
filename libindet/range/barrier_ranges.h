#pragma once

#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include "libindet/barrier/verified_equations.h"
#include "libindet/packing/packing.h"
#include "libindet/polytope/force_polytope.h"
#include "libindet/range/central_widths.h"
#include "libindet/range/duals.h"
#include "libindet/range/enclosure.h"
#include "libindet/range/extrema.h"
#include "libindet/range/growth_search.h"
#include "libindet/range/interval_search.h"
#include "libindet/range/reactions.h"

namespace indet {

/// The second and third stage of an analysis by the barrier method: intervals of all values that were asked
/// for, without states.
struct BarrierRanges {
  Extrema extrema;        ///< claims kEnclosed, no vertex; or kUnbounded, with a ray
  Enclosures enclosures;  ///< their intervals
  Reactions reactions;    ///< complete
  Duals duals;            ///< of the contacts that were chosen, if the polytope has a centre
};

/// What the searches of all values share, whatever part of them is looked for at a time: found once, so that
/// a value is the same to the last bit in whatever part it is found.
struct BarrierPreparation {
  /// Of a value: whether it is a reaction, its row and its column.
  using Key = std::tuple<bool, Eigen::Index, int>;

  std::vector<int> contacts;    ///< whose values are wanted in all, ascending
  bool reactions = false;       ///< are wanted, too
  CentralWidths widths;         ///< about the centre
  std::vector<int> with_duals;  ///< contacts whose duals are kept, ascending
  std::int64_t dual_seed = -1;  ///< that drew these
  Growth growth;                ///< of an unbounded polytope: the rays of all values together
  std::map<Key, int> ray_of;    ///< the ray of each value that grows without limit
};

/// `contacts`: ascending. `widths`: of no rows where they are not known yet. Throws Interrupted; InputError
/// if duals are wanted of an unbounded polytope.
BarrierPreparation prepare_barrier_ranges(const Packing& packing, const ForcePolytope& polytope,
                                          std::vector<int> contacts, CentralWidths widths, bool reactions,
                                          const IntervalOptions& options, const DualChoice& duals = {});

/// `contacts`: some of the prepared ones, ascending; reactions are found with the first of these. A force
/// that is the same in all states by its width (determined_forces.h), or because no edge of its contact is
/// open, needs no search. Where F is empty there are no values. Where it is unbounded, those that grow
/// without limit have a ray, and the others are found in the part of F within a limit; all are kFailed if
/// nothing is proven of it (ForcePolytope::unbounded). On any thread; throws Interrupted.
BarrierRanges find_barrier_ranges(const Packing& packing, const ForcePolytope& polytope,
                                  const BarrierPreparation& prepared, const std::vector<int>& contacts,
                                  const IntervalOptions& options);
/// All at once.
BarrierRanges find_barrier_ranges(const Packing& packing, const ForcePolytope& polytope,
                                  const std::vector<int>& contacts, const CentralWidths& widths,
                                  bool reactions, const IntervalOptions& options);

/// Bounds of a value in the scene's units, rounded outwards, from those of the least value of the objective
/// sign · value in the problem's.
barrier::ValueBounds value_bounds(const barrier::ValueBounds& least, double sign,
                                  const EquilibriumProblem& problem);

/// What an interval is as a result: its middle is the value; it is enclosed if it is no wider than asked for.
struct EnclosedValue {
  double value = 0;
  Outcome outcome = Outcome::kFailed;
};
/// In the scene's units; `weight`: 1 mg in them.
EnclosedValue enclosed_value(double lower, double upper, double gap, double weight);

}  // namespace indet
