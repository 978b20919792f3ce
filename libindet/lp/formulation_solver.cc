#include "libindet/lp/formulation_solver.h"

#include <algorithm>

namespace indet {
namespace {

GlpkProblem::Simplex other(GlpkProblem::Simplex simplex) {
  return simplex == GlpkProblem::Simplex::kPrimal ? GlpkProblem::Simplex::kDual
                                                  : GlpkProblem::Simplex::kPrimal;
}

/// Pivots before a start is given up: among degenerate vertices GLPK can walk in circles, and rounding in old
/// factors can keep it at an optimum for ever. Solves take about as many pivots as there are dimensions,
/// seldom twice as many.
int warm_limit(int dim) { return 4 * dim + 200; }

}  // namespace

FormulationSolver::FormulationSolver(const SlopeView& view, Formulation formulation, const LpOptions& options)
    : view_(view), options_(options), layout_(make_layout(view, formulation)) {}

LpAnswer FormulationSolver::maximise(const Objective& objective, const Basis& start,
                                     std::span<const int> held) {
  LpAnswer answer;
  const bool has_start = static_cast<int>(start.size()) == view_.dim() && !start.empty();
  const Rung first = !has_start ? kCold : stands_at(start) ? kGoOn : kWarm;
  for (int rung = first; rung < kRungs; ++rung) {
    ++answer.attempts;
    try {
      answer.status = attempt(static_cast<Rung>(rung), objective, start, held, answer);
    } catch (const GlpkAborted&) {
      problem_.reset();
      answer.status = LpStatus::kFailed;
    }
    answer.continued = rung == kGoOn;
    if (answer.status != LpStatus::kFailed) break;
  }
  if (answer.status != LpStatus::kOptimal) answer.basis.clear();
  return answer;
}

GlpkProblem::Settings FormulationSolver::settings(Rung rung) const {
  GlpkProblem::Settings result;
  result.keep_factors = rung == kGoOn;
  result.simplex = rung == kWarmOther ? other(layout_->warm_simplex()) : layout_->warm_simplex();
  result.feasibility = options_.feasibility;
  result.optimality = options_.optimality;
  result.iteration_limit = options_.iteration_limit;
  if (rung < kCold) result.iteration_limit = std::min(result.iteration_limit, warm_limit(view_.dim()));
  result.time_limit = options_.time_limit;
  result.presolve = rung == kPresolved;
  return result;
}

bool FormulationSolver::stands_at(const Basis& start) const {
  return problem_ && problem_->is_alive() && start == factorised_;
}

/// One rung; kFailed if it brings nothing.
LpStatus FormulationSolver::attempt(Rung rung, const Objective& objective, const Basis& start,
                                    std::span<const int> held, LpAnswer& answer) {
  if (!problem_ || !problem_->is_alive()) {
    problem_ = layout_->build();
    factorised_.clear();
  }
  layout_->set_objective(*problem_, objective);
  layout_->hold(*problem_, held, true);
  if (rung == kGoOn) {
    // GLPK stands at the start.
  } else if (rung == kWarm || rung == kWarmOther) {
    layout_->set_start(*problem_, start);
  } else {
    problem_->advanced_basis();
  }
  if (rung == kPresolved) problem_->scale(true);
  const GlpkProblem::Result result = problem_->solve(settings(rung));
  answer.pivots += problem_->pivots();
  answer.basis = layout_->read_basis(*problem_);
  factorised_ = rung == kPresolved ? Basis() : answer.basis;
  if (rung == kPresolved) problem_->scale(false);
  layout_->hold(*problem_, held, false);
  const LpStatus status = layout_->interpret(result);
  const bool complete = static_cast<int>(answer.basis.size()) == view_.dim();
  return status == LpStatus::kOptimal && !complete ? LpStatus::kFailed : status;
}

}  // namespace indet
