#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "libindet/lp/feasible_set.h"
#include "libindet/lp/vertex.h"
#include "libindet/range/component.h"
#include "libindet/range/paper_work.h"
#include "libindet/range/search_options.h"

namespace indet {

/// What was found about one objective.
struct Extremum {
  enum class Status : std::uint8_t { kOpen, kOptimal, kUnbounded, kFailed };
  Status status = Status::kOpen;
  double value = 0;
  int vertex = -1;  ///< index into SearchResult::vertices; −1 also where a sink has taken them
  /// The vertex that settled the value, before canonical states are looked for: of the vertices in the order
  /// of the search the first that is optimal, because its reduced costs prove it or because the solver
  /// stopped there. It is `vertex` of a search without canonical states. −1 where not asked for
  /// (solver_states).
  int solver_vertex = -1;
  double dual_residual = 0;  ///< largest wrong-signed reduced cost of the proof
  Basis proof;  ///< the basis whose reduced costs prove the value; at a degenerate vertex that of `vertex`
                ///< need not
  bool unique = false;  ///< the vertex is the only point that attains the value
};

struct SearchResult {
  std::vector<Extremum> minimum, maximum;  ///< one a component; kOpen where not asked for
  std::vector<Vertex> vertices;            ///< those that some extremum points to, without their factors;
                                           ///< none where a sink has taken them
  std::int64_t solves = 0;
  std::int64_t continued = 0;  ///< solves that began with the factors of the one before (kLp)
  std::int64_t pivots = 0;
  PaperWork paper;           ///< of kPivotingPaper: its walks
  double state_seconds = 0;  ///< of the time, what the canonical states took
};

/// Minima and maxima of many functionals over one bounded, full-dimensional FeasibleSet, of which `view` is
/// the view.
///
/// kLp and kPivotingTableau: each objective starts from the known vertex with the best value of its
/// objective; a basis once feasible stays feasible. Every vertex reached is then tried on all objectives that
/// it improves or ties: with the d active inequalities N, the row −g S_N⁻¹ holds the reduced costs of
/// objective g, and a row without a negative entry proves the vertex optimal. Only those rows are computed
/// that can change something, so this costs far less than the whole product.
///
/// kPivotingPaper: each objective is walked to by itself (paper_walk.h). Canonical states are then found by
/// linear programs.
///
/// Objectives are worked on in rounds (search_rounds.h): the result does not depend on the number of threads.
/// Extremal states: canonical_states.h.
///
/// `known`: further vertices, which are tried on all objectives before any is searched for.
///
/// Preconditions: the set is full-dimensional; `start` is a vertex; weight > 0. Functionals that are
/// unbounded over the set end as kUnbounded.
SearchResult search_extrema(const SlopeView& view, const std::vector<Component>& components,
                            const Eigen::VectorXd& weight, const Basis& start, const SearchOptions& options,
                            std::span<const Basis> known = {});

}  // namespace indet
