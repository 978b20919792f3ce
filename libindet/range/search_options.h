#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "libindet/base/progress.h"
#include "libindet/lp/lp_solver.h"
#include "libindet/lp/vertex.h"
#include "libindet/pivoting/pivot_rule.h"
#include "libindet/range/method.h"
#include "libindet/range/paper_options.h"

namespace indet {

/// Told of a vertex and of the objectives that it settles (of which component c is minimised by 2c, maximised
/// by 2c + 1).
using VertexSink = std::function<void(const Vertex& vertex, std::span<const std::int64_t> objectives)>;

struct SearchOptions {
  Method method = Method::kLp;
  Formulation formulation = Formulation::kDual;     ///< of kLp, and of the states of kPivotingPaper
  PivotRule pivot_rule = PivotRule::kSteepestEdge;  ///< of kPivotingTableau
  PaperOptions paper;                               ///< of kPivotingPaper
  LpOptions lp;
  int threads = 1;
  /// Take the state of smallest `weight` on each optimal face, so that every method gives the same one; else
  /// the state that the solver happens to find.
  bool canonical_states = true;
  /// Tell for each objective also the state that the solver happens to find (Extremum::solver_vertex).
  bool solver_states = false;
  /// Where set, vertices are handed over as they settle objectives, each of these once, on the calling
  /// thread; of those passed only the bases are held. Not with canonical_states or solver_states.
  VertexSink sink;
  /// Called now and then with how much of how much work is done; false stops the search (Interrupted).
  StageProgress progress;
};

}  // namespace indet
