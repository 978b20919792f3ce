#pragma once

#include <vector>

#include "libindet/packing/force_bounds.h"
#include "libindet/packing/packing.h"
#include "libindet/range/outcome.h"

namespace indet {

/// How far a state is from admissible.
struct StateResidual {
  /// The worst violation of equilibrium, friction or a bound of a force, over the largest of its forces.
  double primal = 0;
  double imbalance = 0;  ///< ‖cF + w‖∞ (mg)
};

/// Recomputes residuals of contact states from the packing, contact by contact.
class StateChecker {
 public:
  /// `packing` must outlive the checker.
  explicit StateChecker(const Packing& packing)
      : packing_(packing), bounds_(force_bounds(packing)), unit_(packing.force_unit()) {}

  StateResidual operator()(const SceneForces& forces) const;

 private:
  const Packing& packing_;
  std::vector<ForceBound> bounds_;
  double unit_;
};

/// What is read from the states that attain the extrema, at a time when these are at hand; whether they are
/// kept is another question. M contacts. Forces are in the scene's units.
struct AttainedValues {
  Table4<double> value;            ///< NaN where no state attains it.
  Table4<double> primal_residual;  ///< Of that state; NaN where there is none.
  double imbalance = 0;            ///< The largest of all states (mg).

  /// Without any.
  void clear(Eigen::Index contacts);
  /// Notes that a state attains this extremum.
  void note(Eigen::Index contact, int column, const SceneForces& forces, const StateResidual& residual);
};

/// The values of all extrema that point to a row of `states`.
void note_states(const Rows<double>& states, const Table4<std::int32_t>& vertex, const StateChecker& check,
                 AttainedValues& attained);

}  // namespace indet
