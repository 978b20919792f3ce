#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

#include "libindet/lp/feasible_set.h"
#include "libindet/lp/lp_solver.h"
#include "libindet/lp/vertex.h"
#include "libindet/pivoting/pivot_rule.h"
#include "libindet/range/examiner.h"
#include "libindet/range/method.h"
#include "libindet/range/paper_work.h"

namespace indet {

struct SearchOptions {
  Method method = Method::kLp;
  Formulation formulation = Formulation::kDual;     ///< of kLp, and of the states of kPivotingPaper
  PivotRule pivot_rule = PivotRule::kSteepestEdge;  ///< of kPivotingTableau
  LpOptions lp;
  int threads = 1;
  /// Take the state of smallest `weight` on each optimal face, so that every method gives the same one; else
  /// the vertex that the solver lands on.
  bool canonical_states = true;
  /// Called now and then with the numbers of objectives settled and asked for; false stops the search
  /// (Interrupted).
  std::function<bool(std::int64_t settled, std::int64_t total)> progress;
};

/// What was found about one objective.
struct Extremum {
  enum class Status : std::uint8_t { kOpen, kOptimal, kUnbounded, kFailed };
  Status status = Status::kOpen;
  double value = 0;
  int vertex = -1;           ///< index into SearchResult::vertices
  double dual_residual = 0;  ///< largest wrong-signed reduced cost of the proof
  Basis proof;  ///< the basis whose reduced costs prove the value; at a degenerate vertex that of `vertex`
                ///< need not
  bool unique = false;  ///< the vertex is the only point that attains the value
};

struct SearchResult {
  std::vector<Extremum> minimum, maximum;  ///< one a component; kOpen where not asked for
  std::vector<Vertex> vertices;            ///< those that some extremum points to, without their factors
  std::int64_t solves = 0;
  std::int64_t continued = 0;  ///< solves that began with the factors of the one before (kLp)
  std::int64_t pivots = 0;
  PaperWork paper;           ///< of kPivotingPaper: its walks
  double state_seconds = 0;  ///< of the time, what the canonical states took
};

/// Minima and maxima of many functionals over one bounded, full-dimensional FeasibleSet.
///
/// kLp and kPivotingTableau: each objective starts from the known vertex with the best value of its
/// objective; a basis once feasible stays feasible. Every vertex reached is then tried on all objectives that
/// it improves or ties: with the d active inequalities N, the row −g S_N⁻¹ holds the reduced costs of
/// objective g, and a row without a negative entry proves the vertex optimal. Only those rows are computed
/// that can change something, so this costs far less than the whole product.
///
/// kPivotingPaper: each objective is walked to by itself, a minimum from `start`, the maximum from that
/// minimum, and nothing is learned from other objectives. Canonical states are then found by linear programs.
///
/// Objectives are worked on in rounds of fixed size, whose members start from what was known before the
/// round: the result does not depend on the number of threads.
///
/// Extremal states: on the optimal face {x : x_k = 0 for all k with positive reduced cost} the state of
/// smallest weight·x is taken, and among equals the smallest of a fixed generic functional.
///
/// Preconditions: the set is full-dimensional; `start` is a vertex; weight > 0. Functionals that are
/// unbounded over the set end as kUnbounded.
SearchResult search_extrema(const FeasibleSet& set, const std::vector<Component>& components,
                            const Eigen::VectorXd& weight, const Basis& start, const SearchOptions& options);

}  // namespace indet
