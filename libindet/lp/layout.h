#pragma once

#include <memory>
#include <span>

#include "libindet/lp/feasible_set.h"
#include "libindet/lp/glpk_problem.h"
#include "libindet/lp/lp_solver.h"

namespace indet {

/// How one formulation lays a FeasibleSet out in GLPK, and how a Basis reads there. One file a formulation.
class Layout {
 public:
  virtual ~Layout() = default;
  /// A new problem holding the constraints; the objective is zero.
  virtual std::unique_ptr<GlpkProblem> build() const = 0;
  virtual void set_objective(GlpkProblem& problem, const Objective& objective) = 0;
  virtual void set_start(GlpkProblem& problem, std::span<const int> basis) const = 0;
  /// Holds x_k = 0 for all k in `held`, or lets them be ≥ 0 again.
  virtual void hold(GlpkProblem& problem, std::span<const int> held, bool on) const = 0;
  /// The active inequalities of the optimal basis found.
  virtual Basis read_basis(const GlpkProblem& problem) const = 0;
  /// The simplex for which a feasible vertex is a feasible start.
  virtual GlpkProblem::Simplex warm_simplex() const = 0;
  /// What GLPK's result says about the FeasibleSet.
  virtual LpStatus interpret(GlpkProblem::Result result) const = 0;
};

std::unique_ptr<Layout> make_null_space_layout(const SlopeView& view);
std::unique_ptr<Layout> make_dual_layout(const SlopeView& view);
std::unique_ptr<Layout> make_edge_layout(const FeasibleSet& set);

/// What GLPK's result says about a polyhedron that it has as it is, not as a dual.
LpStatus status_of(GlpkProblem::Result result);

/// The layout of the given formulation. `view` must outlive it, and has a set for kEdge.
std::unique_ptr<Layout> make_layout(const SlopeView& view, Formulation formulation);

}  // namespace indet
