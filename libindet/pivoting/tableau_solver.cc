#include "libindet/pivoting/tableau_solver.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "libindet/base/tolerances.h"

namespace indet {
namespace {

/// Steps without gain after which Bland's rule takes over.
constexpr int kStalled = 40;
/// Exchanges after which the tableau is factorised anew, whatever its error.
constexpr std::int64_t kRenewal = 2000;

}  // namespace

TableauSolver::TableauSolver(const SlopeView& view, PivotRule rule, const LpOptions& options)
    : rule_(rule), options_(options), tableau_(view, rule == PivotRule::kSteepestEdge) {}

LpAnswer TableauSolver::maximise(const Objective& objective, const Basis& start, std::span<const int> held) {
  LpAnswer answer;
  answer.attempts = 1;
  if (since_built_ > kRenewal) since_built_ = tableau_.build(start) ? 0 : since_built_;
  if (!tableau_.move_to(start) || (tableau_.error() > tolerance::kTableauError && !tableau_.build(start)))
    return answer;
  if (!hold(held, answer.pivots)) return answer;
  answer.status = climb(objective, answer.pivots);
  since_built_ += answer.pivots;
  if (answer.status == LpStatus::kOptimal) answer.basis = tableau_.basis();
  return answer;
}

/// Makes the held inequalities active where they are not, at a vertex where they hold with equality.
bool TableauSolver::hold(std::span<const int> held, std::int64_t& pivots) {
  is_held_.assign(tableau_.active().size(), 0);
  for (const int k : held) {
    if (tableau_.column_of(k) >= 0) is_held_[static_cast<std::size_t>(tableau_.column_of(k))] = 1;
  }
  for (const int k : held) {
    const int row = tableau_.row_of(k);
    if (row < 0) continue;
    int column = -1;
    for (int j = 0; j < static_cast<int>(is_held_.size()); ++j) {
      if (is_held_[static_cast<std::size_t>(j)] != 0) continue;
      const double rate = std::abs(tableau_.rates()(row, j));
      if (rate > (column < 0 ? tolerance::kDependentRate : std::abs(tableau_.rates()(row, column))))
        column = j;
    }
    if (column < 0) continue;  // the other held ones hold it
    tableau_.pivot(row, column);
    is_held_[static_cast<std::size_t>(column)] = 1;
    ++pivots;
  }
  return tableau_.slacks().size() == 0 || tableau_.slacks().minCoeff() > -tolerance::kHeldSlack;
}

LpStatus TableauSolver::climb(const Objective& objective, std::int64_t& pivots) {
  const auto begin = std::chrono::steady_clock::now();
  Eigen::VectorXd gradient = tableau_.gradient(objective);
  bool is_fresh = true;  // the gradient was not carried along
  int stalled = 0;
  for (;;) {
    const bool careful = stalled > kStalled;
    const int column = careful ? choose_column_by_number(tableau_, gradient, is_held_, options_.optimality)
                               : choose_column(tableau_, gradient, is_held_, rule_, options_.optimality);
    if (column < 0) {
      const bool is_sound = tableau_.error() <= tolerance::kTableauError;
      if (is_fresh && is_sound) return LpStatus::kOptimal;
      if (!is_sound && !repair()) return LpStatus::kFailed;
      gradient = tableau_.gradient(objective);
      is_fresh = true;
      continue;
    }
    const int row =
        careful ? first_stop_by_number(tableau_, column) : first_stop(tableau_, column, tolerance::kHarris);
    if (row < 0) {
      if (tableau_.error() <= tolerance::kTableauError) return LpStatus::kUnbounded;
      if (!repair()) return LpStatus::kFailed;
      gradient = tableau_.gradient(objective);
      continue;
    }
    const double length = tableau_.slacks()[row] / -tableau_.rates()(row, column);
    stalled = length * gradient[column] > tolerance::kStalledGain ? 0 : stalled + 1;
    const double slope = gradient[column];
    tableau_.pivot(row, column);
    gradient[column] = 0;
    gradient += slope * tableau_.rates().row(row).transpose();
    is_fresh = false;
    ++pivots;
    if (pivots >= options_.iteration_limit) return LpStatus::kFailed;
    constexpr std::int64_t kClock = 64;
    const auto elapsed = std::chrono::steady_clock::now() - begin;
    if (pivots % kClock == 0 && std::chrono::duration<double>(elapsed).count() > options_.time_limit)
      return LpStatus::kFailed;
  }
}

/// Factorises the present vertex anew; held columns keep their mark.
bool TableauSolver::repair() {
  std::vector<int> held;
  for (std::size_t j = 0; j < is_held_.size(); ++j) {
    if (is_held_[j] != 0) held.push_back(tableau_.active()[j]);
  }
  if (!tableau_.build(tableau_.basis())) return false;
  is_held_.assign(is_held_.size(), 0);
  for (const int k : held) is_held_[static_cast<std::size_t>(tableau_.column_of(k))] = 1;
  since_built_ = 0;
  return tableau_.error() <= tolerance::kTableauError;
}

}  // namespace indet
