#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "libindet/base/tolerances.h"
#include "libindet/lp/feasible_set.h"
#include "libindet/lp/maximiser.h"

namespace indet {

/// How a linear program over a FeasibleSet is given to the simplex method (docs/theory.md). All three take
/// and return the same warm start, a Basis.
enum class Formulation : std::uint8_t {
  kNullSpace,  ///< the slope view: K rows × d free dense columns; primal simplex
  kDual,       ///< its dual: d rows × K columns, the objective is the right-hand side; dual simplex
  kEdge        ///< the set itself: r sparse equations × K columns ≥ 0; primal simplex
};

const char* to_string(Formulation formulation);

struct LpOptions {
  double feasibility = tolerance::kLpFeasibility;  ///< GLPK's tol_bnd
  double optimality = tolerance::kLpOptimality;    ///< GLPK's tol_dj
  int iteration_limit = 100000;                    ///< pivots a solve
  double time_limit = 600;                         ///< seconds a solve
};

/// Maximises linear objectives over one FeasibleSet by GLPK, from given start vertices. A start that is the
/// last vertex found goes on with the factors that GLPK has of it, so that the path of an answer, through
/// rounding, depends on what was asked before. GLPK keeps its state per thread, so a solver must be created,
/// used and destroyed on one thread.
///
/// Where one formulation finds no optimum (formulation_solver.h), the others are tried, dual, edge,
/// nullspace, from the same start; kEdge only where the view has a set. A basis proves an
/// optimum, and is taken whoever found it; that there is none is believed once two formulations say the same,
/// or one says so and the others fail.
class LpSolver : public Maximiser {
 public:
  /// Precondition: for kEdge the view has a set. `view` must outlive the solver.
  LpSolver(const SlopeView& view, Formulation formulation, const LpOptions& options = {});
  ~LpSolver() override;
  LpSolver(const LpSolver&) = delete;
  LpSolver& operator=(const LpSolver&) = delete;

  /// An empty `start` asks for a cold start.
  LpAnswer maximise(const Objective& objective, const Basis& start, std::span<const int> held = {}) override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace indet
