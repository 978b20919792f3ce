#include "libindet/limit/limit_program.h"

#include <utility>

#include "libindet/lp/layout.h"

namespace indet {
namespace {

/// Ways to try in turn: from where the last solve ended by either simplex method, from GLPK's advanced basis,
/// presolved and rescaled.
enum Rung : int { kGoOn, kGoOnDual, kCold, kPresolved, kRungs };

}  // namespace

LimitProgram::LimitProgram(const EquilibriumProblem& problem, const LpOptions& options)
    : LimitProgram(problem,
                   problem.right_hand_sides.cols() > 1 ? Eigen::VectorXd(problem.right_hand_sides.col(1))
                                                       : Eigen::VectorXd(),
                   options) {}

LimitProgram::LimitProgram(const EquilibriumProblem& problem, Eigen::VectorXd change,
                           const LpOptions& options)
    : problem_(&problem), options_(options), change_(std::move(change)) {
  scale();
}

void LimitProgram::scale() {
  const double largest = has_change() ? change_.lpNorm<Eigen::Infinity>() : 0;
  scale_ = largest > 0 ? largest : 1;
  if (has_change()) change_ /= scale_;
}

void LimitProgram::replace(const EquilibriumProblem& problem, Eigen::VectorXd change) {
  problem_ = &problem;
  change_ = std::move(change);
  scale();
  if (program_) load();
}

void LimitProgram::build() {
  const int lambda = problem_->unknowns();
  program_ = std::make_unique<GlpkProblem>(problem_->equations(), lambda + (has_change() ? 1 : 0), true);
  for (int k = 0; k < lambda; ++k) program_->bound_column(k, GlpkProblem::Bound::kLower, 0);
  if (has_change()) program_->bound_column(lambda, GlpkProblem::Bound::kFree, 0);
  load();
  has_basis_ = false;
}

void LimitProgram::load() {
  const int lambda = problem_->unknowns();
  std::vector<GlpkProblem::Entry> entries;
  for (int k = 0; k < lambda; ++k) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(problem_->edge_matrix, k); it; ++it) {
      if (it.value() != 0) entries.push_back({static_cast<int>(it.row()), k, it.value()});
    }
  }
  for (int i = 0; i < problem_->equations(); ++i) {
    program_->bound_row(i, GlpkProblem::Bound::kFixed, problem_->right_hand_sides(i, 0));
    if (has_change() && change_[i] != 0) entries.push_back({i, lambda, -change_[i]});
  }
  program_->load(entries);
}

LpStatus LimitProgram::attempt(int rung) {
  GlpkProblem::Settings settings;
  settings.simplex = rung == kGoOnDual ? GlpkProblem::Simplex::kDual : GlpkProblem::Simplex::kPrimal;
  settings.feasibility = options_.feasibility;
  settings.optimality = options_.optimality;
  settings.iteration_limit = options_.iteration_limit;
  settings.time_limit = options_.time_limit;
  settings.presolve = rung == kPresolved;
  if (rung == kCold || rung == kPresolved) program_->advanced_basis();
  if (rung == kPresolved) program_->scale(true);
  const LpStatus status = status_of(program_->solve(settings));
  if (rung == kPresolved) program_->scale(false);
  return status;
}

LimitProgram::Answer LimitProgram::find(int sign) {
  Answer answer;
  if (!program_) build();
  for (int rung = has_basis_ ? kGoOn : kCold; rung < kRungs; ++rung) {
    if (has_change()) program_->set_cost(problem_->unknowns(), sign);
    try {
      answer.status = attempt(rung);
    } catch (const GlpkAborted&) {
      build();
      answer.status = LpStatus::kFailed;
    }
    if (answer.status != LpStatus::kFailed) break;
  }
  has_basis_ = answer.status == LpStatus::kOptimal || answer.status == LpStatus::kUnbounded;
  answer.basic.resize(static_cast<std::size_t>(problem_->unknowns()));
  for (int k = 0; k < problem_->unknowns(); ++k)
    answer.basic[static_cast<std::size_t>(k)] = program_->is_column_basic(k);
  if (!has_change()) return answer;
  answer.lambda_is_basic = program_->is_column_basic(problem_->unknowns());
  answer.lambda = program_->column_value(problem_->unknowns()) / scale_;
  return answer;
}

}  // namespace indet
