#include "libindet/lp/lp_solver.h"

#include <array>
#include <vector>

#include "libindet/base/error.h"
#include "libindet/lp/formulation_solver.h"
#include "libindet/lp/layout.h"

namespace indet {
namespace {

constexpr std::array kFormulations = {Formulation::kDual, Formulation::kEdge, Formulation::kNullSpace};

/// The formulation that was asked for, and those that step in where it fails.
std::vector<Formulation> order_of(const SlopeView& view, Formulation first) {
  std::vector<Formulation> order{first};
  for (const Formulation formulation : kFormulations) {
    const bool is_described = formulation != Formulation::kEdge || view.set;
    if (formulation != first && is_described) order.push_back(formulation);
  }
  return order;
}

}  // namespace

LpStatus status_of(GlpkProblem::Result result) {
  switch (result) {
    case GlpkProblem::Result::kOptimal:
      return LpStatus::kOptimal;
    case GlpkProblem::Result::kInfeasible:
      return LpStatus::kInfeasible;
    case GlpkProblem::Result::kUnbounded:
      return LpStatus::kUnbounded;
    default:
      return LpStatus::kFailed;
  }
}

std::unique_ptr<Layout> make_layout(const SlopeView& view, Formulation formulation) {
  switch (formulation) {
    case Formulation::kNullSpace:
      return make_null_space_layout(view);
    case Formulation::kDual:
      return make_dual_layout(view);
    case Formulation::kEdge:
      return make_edge_layout(*view.set);
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
  const SlopeView& view;
  LpOptions options;
  std::vector<Formulation> order;
  std::vector<std::unique_ptr<FormulationSolver>> solvers;  ///< in that order; made where needed

  FormulationSolver& solver(std::size_t i) {
    if (i == solvers.size()) solvers.push_back(std::make_unique<FormulationSolver>(view, order[i], options));
    return *solvers[i];
  }
};

LpSolver::LpSolver(const SlopeView& view, Formulation formulation, const LpOptions& options)
    : impl_(std::make_unique<Impl>(Impl{view, options, order_of(view, formulation), {}})) {}

LpSolver::~LpSolver() = default;

LpAnswer LpSolver::maximise(const Objective& objective, const Basis& start, std::span<const int> held) {
  LpAnswer answer;
  answer.solves = 0;
  for (std::size_t i = 0; i < impl_->order.size(); ++i) {
    LpAnswer next = impl_->solver(i).maximise(objective, start, held);
    next.solves += answer.solves;
    next.pivots += answer.pivots;
    next.attempts += answer.attempts;
    const bool agrees = next.status != LpStatus::kFailed && next.status == answer.status;
    const LpStatus before = answer.status;
    answer = std::move(next);
    if (answer.status == LpStatus::kOptimal || agrees) break;
    if (before != LpStatus::kFailed) answer.status = before;
  }
  return answer;
}

}  // namespace indet
