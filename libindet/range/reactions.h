#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "libindet/lp/lp_solver.h"
#include "libindet/packing/packing.h"
#include "libindet/polytope/force_polytope.h"
#include "libindet/range/enclosure.h"
#include "libindet/range/extrema.h"
#include "libindet/range/outcome.h"

namespace indet {

/// What contacts exert on the bodies that hold a packing: a sum over the contacts of one body,
///
///   wall        component 0: ΣR, 1: ΣT (along its own normal and tangent; of a loaded wall its loads)
///   fixed disk  component 0, 1: Σ force on it, x and y; 2: Σ l T, the torque on it
///
/// Walls come first, then fixed disks; bodies without contacts are left out, ΣT of frictionless walls too.
struct ReactionSum {
  Body body;
  int component = 0;
  Eigen::VectorXd coefficients;  ///< 2M: the sum is coefficients · (R_1, T_1, …)
};
std::vector<ReactionSum> reaction_sums(const Packing& packing);

/// One entry for each sum: its smallest and its largest value.
template <class T>
using Table2 = Eigen::Array<T, Eigen::Dynamic, 2, Eigen::RowMajor>;

/// The ranges of reactions over F, in the scene's units (torques: force times length). P sums.
struct Reactions {
  Eigen::Array<std::int32_t, Eigen::Dynamic, 1> body;       ///< Body::code()
  Eigen::Array<std::int32_t, Eigen::Dynamic, 1> component;  ///< of ReactionSum
  Table2<double> value;         ///< ±inf where unbounded, NaN where not found or F is empty
  Table2<double> lower, upper;  ///< rigorous enclosure of the value
  Table2<Outcome> outcome;
  Rows<double> states;          ///< [S, 2M]: states that attain the values
  Table2<std::int32_t> vertex;  ///< row of `states`; −1: none
  Rows<double> rays;         ///< [U, 2M]: directions of ker c ∩ K along which values grow (largest entry 1)
  Table2<std::int32_t> ray;  ///< row of `rays`; −1: none

  Eigen::Index count() const { return body.size(); }
  std::int64_t certified() const {
    return number_of(Outcome::kOptimal) + number_of(Outcome::kUnbounded) + number_of(Outcome::kEnclosed);
  }
  std::int64_t uncertain() const { return number_of(Outcome::kImprecise) + number_of(Outcome::kFailed); }
  std::int64_t number_of(Outcome one) const { return (outcome == one).count(); }
};

/// Finds the extrema of each sum, block by block, each value recomputed from the state that attains it.
/// kOptimal: the state balances, keeps to friction, and its reduced costs prove it, as for contacts
/// (certify.h). Throws LibraryError.
struct FoundReactions {
  Reactions reactions;                ///< without enclosures
  std::vector<SumAtOptimum> optima;   ///< of those that have a value: minimum and maximum of each sum in turn
  std::vector<std::int32_t> entries;  ///< of each optimum: 2 · row + (0 minimum, 1 maximum)
};
/// Each search starts from that extremal state of `extrema` at which the sum is largest.
FoundReactions find_reactions(const Packing& packing, const ForcePolytope& polytope, const Extrema& extrema,
                              Formulation formulation, const LpOptions& options);

/// Puts the enclosures (of the `optima`, in their order) in. Where `proven` is not set, nothing is certified.
Reactions certify_reactions(const FoundReactions& found, const std::vector<SumBounds>& bounds, bool proven);

}  // namespace indet
