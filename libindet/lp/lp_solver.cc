#include "libindet/lp/lp_solver.h"

#include <algorithm>

#include "libindet/base/error.h"
#include "libindet/lp/layout.h"

namespace indet {
namespace {

GlpkProblem::Simplex other(GlpkProblem::Simplex simplex) {
  return simplex == GlpkProblem::Simplex::kPrimal ? GlpkProblem::Simplex::kDual
                                                  : GlpkProblem::Simplex::kPrimal;
}

/// Pivots before old factors are given up: rounding in them can keep GLPK at an optimum for ever. Solves take
/// about as many pivots as there are dimensions, seldom twice as many.
int going_on_limit(int dim) { return 20 * dim + 200; }

/// The rungs of the ladder.
enum Rung : int { kGoOn, kWarm, kWarmOther, kCold, kPresolved, kRungs };

}  // namespace

std::unique_ptr<Layout> make_layout(const FeasibleSet& set, Formulation formulation) {
  switch (formulation) {
    case Formulation::kNullSpace:
      return make_null_space_layout(set);
    case Formulation::kDual:
      return make_dual_layout(set);
    case Formulation::kEdge:
      return make_edge_layout(set);
  }
  throw LibraryError("unknown formulation");
}

const char* to_string(Formulation formulation) {
  switch (formulation) {
    case Formulation::kNullSpace:
      return "nullspace";
    case Formulation::kDual:
      return "dual";
    case Formulation::kEdge:
      return "edge";
  }
  return "?";
}

struct LpSolver::Impl {
  Impl(const FeasibleSet& s, Formulation formulation, const LpOptions& o)
      : set(s), options(o), layout(make_layout(s, formulation)) {}

  const FeasibleSet& set;
  LpOptions options;
  std::unique_ptr<Layout> layout;
  std::unique_ptr<GlpkProblem> problem;
  Basis factorised;  ///< where GLPK stands, with factors

  GlpkProblem::Settings settings(int rung) const {
    GlpkProblem::Settings result;
    result.keep_factors = rung == kGoOn;
    result.simplex = rung == kWarmOther ? other(layout->warm_simplex()) : layout->warm_simplex();
    result.feasibility = options.feasibility;
    result.optimality = options.optimality;
    result.iteration_limit = options.iteration_limit;
    if (rung == kGoOn) result.iteration_limit = std::min(result.iteration_limit, going_on_limit(set.dim()));
    result.time_limit = options.time_limit;
    result.presolve = rung == kPresolved;
    return result;
  }

  bool stands_at(const Basis& start) const { return problem && problem->is_alive() && start == factorised; }

  /// One rung; kFailed if it brings nothing.
  LpStatus attempt(int rung, const Objective& objective, const Basis& start, std::span<const int> held,
                   LpAnswer& answer) {
    if (!problem || !problem->is_alive()) {
      problem = layout->build();
      factorised.clear();
    }
    layout->set_objective(*problem, objective);
    layout->hold(*problem, held, true);
    if (rung == kGoOn) {
      // GLPK stands at the start.
    } else if (rung == kWarm || rung == kWarmOther) {
      layout->set_start(*problem, start);
    } else {
      problem->advanced_basis();
    }
    if (rung == kPresolved) problem->scale(true);
    const GlpkProblem::Result result = problem->solve(settings(rung));
    answer.pivots += problem->pivots();
    answer.basis = layout->read_basis(*problem);
    factorised = rung == kPresolved ? Basis() : answer.basis;
    if (rung == kPresolved) problem->scale(false);
    layout->hold(*problem, held, false);
    const LpStatus status = layout->interpret(result);
    const bool complete = static_cast<int>(answer.basis.size()) == set.dim();
    return status == LpStatus::kOptimal && !complete ? LpStatus::kFailed : status;
  }
};

LpSolver::LpSolver(const FeasibleSet& set, Formulation formulation, const LpOptions& options)
    : impl_(std::make_unique<Impl>(set, formulation, options)) {}

LpSolver::~LpSolver() = default;

LpAnswer LpSolver::maximise(const Objective& objective, const Basis& start, std::span<const int> held) {
  LpAnswer answer;
  const bool has_start = static_cast<int>(start.size()) == impl_->set.dim() && !start.empty();
  const int first = !has_start ? kCold : impl_->stands_at(start) ? kGoOn : kWarm;
  for (int rung = first; rung < kRungs; ++rung) {
    ++answer.attempts;
    try {
      answer.status = impl_->attempt(rung, objective, start, held, answer);
    } catch (const GlpkAborted&) {
      impl_->problem.reset();
      answer.status = LpStatus::kFailed;
    }
    answer.continued = rung == kGoOn;
    if (answer.status != LpStatus::kFailed) break;
  }
  if (answer.status != LpStatus::kOptimal) answer.basis.clear();
  return answer;
}

}  // namespace indet
