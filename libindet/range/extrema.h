#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "libindet/lp/feasible_set.h"
#include "libindet/packing/packing.h"
#include "libindet/polytope/force_polytope.h"
#include "libindet/range/attained_values.h"
#include "libindet/range/extremal_search.h"
#include "libindet/range/method.h"
#include "libindet/range/outcome.h"
#include "libindet/range/paper_options.h"
#include "libindet/range/paper_work.h"
#include "libindet/range/state_choice.h"

namespace indet {

/// The states and directions that attain the extrema, as far as they are kept. M contacts, K states, Q rays,
/// d = dim F. Forces are in the scene's units.
struct ExtremalStates : KeptStates {
  Rows<double> states;          ///< [K, 2M]: each once, in the order in which `vertex` first points to them.
  Table4<std::int32_t> vertex;  ///< Row of `states`; −1: none is kept, or there is none.
  Table4<std::uint8_t> unique;  ///< 1: the extremal state is the only one that attains the value.
  /// [K, d]: the half-planes that define the state: 2α for μR + T ≥ 0 and 2α + 1 for μR − T ≥ 0 of contact
  /// α (R ≥ 0 is 2α where μ = 0).
  Eigen::Array<std::int32_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> active;
  Rows<double> rays;  ///< [Q, 2M]: directions of ker c ∩ K along which F is unbounded (largest entry 1).
  Table4<std::int32_t>
      ray;  ///< Row of `rays` along which the objective grows without limit; −1: it is limited.
};

/// The states on which the solver landed before canonical ones were looked for (Extremum::solver_vertex): the
/// `states` and `vertex` of a search without canonical states.
struct SolverStates {
  Rows<double> states;          ///< [K, 2M]
  Table4<std::int32_t> vertex;  ///< Row of `states`; −1: none.
};

/// What the search did.
struct SearchWork {
  Method method = Method::kLp;
  std::string formulation;     ///< Of the linear programs, "" where a tableau did without.
  PaperOptions paper_options;  ///< Only of Method::kPivotingPaper.
  PaperWork paper;             ///< The same.
  std::string reason;          ///< Why this method was taken, "" where it was asked for.
  double gap = std::numeric_limits<double>::quiet_NaN();  ///< Of Method::kBarrier: what was asked for.
  std::int64_t solves = 0, pivots = 0;
  std::int64_t determined = 0;  ///< Objectives without a search: the same in every state.
};

/// The basis at which one objective was found optimal.
struct OptimalBasis {
  Eigen::Index contact = 0;
  int column = 0;  ///< Column
  std::size_t block = 0;
  Basis basis;  ///< local to the block
};

/// What the search found and what it claims of it: the second stage of an analysis. Nothing here is
/// certified.
struct Extrema : ExtremalStates, SearchWork, AttainedValues {
  /// kOptimal: some state attains `value`. kUnbounded, or kImprecise without a value: it is −inf (of a
  /// minimum) or +inf along `ray`, which the recession cone contains, or misses by more than its residual may
  /// be.
  Table4<Outcome> claim;
  Table4<double> dual_residual;      ///< Largest reduced cost of the wrong sign; NaN without value and ray.
  Table4<double> ray_residual;       ///< Violation of the recession cone by the ray; NaN without one.
  std::vector<OptimalBasis> proofs;  ///< Objectives with a value and none here are determined.
  double state_seconds = 0;          ///< Of the time, what the canonical states took.
  std::optional<SolverStates> solver_states;  ///< Where asked for, and all states are kept.
};

/// Extrema of R and T of the `contacts` (ascending) over F, block by block. `options.formulation` holds for
/// all blocks; `options.progress` is told of all objectives, 4 a contact, and last of all that all are
/// settled. The paper's method starts where the packing was simulated to be. An empty F has none: every claim
/// is kNotRequested.
///
/// Of the states `kept` says which stay; the others are let go as soon as their values and residuals are
/// noted, and of them a basis is left, the one in `proofs`. Canonical ones are looked for where they are kept
/// only. Throws Interrupted, LibraryError.
Extrema find_extrema(const Packing& packing, const ForcePolytope& polytope, const std::vector<int>& contacts,
                     const StateChoice& kept, const SearchOptions& options);

}  // namespace indet
