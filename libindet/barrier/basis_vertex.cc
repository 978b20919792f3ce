#include "libindet/barrier/basis_vertex.h"

#include <algorithm>
#include <numeric>

#include "libindet/barrier/vectors.h"
#include "libindet/base/tolerances.h"

namespace indet::barrier {
namespace {

constexpr int kMostRounds = 4;

std::size_t at(int column) { return static_cast<std::size_t>(column); }

}  // namespace

BasisVertex::BasisVertex(const BlockStructure& structure)
    : structure_(structure), cholesky_(structure), is_basic_(at(structure.columns())) {}

bool BasisVertex::set_basis(std::span<const double> rank) {
  std::vector<int> order(rank.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return rank[at(a)] > rank[at(b)]; });
  closed_.assign(order.begin() + structure_.rows(), order.end());
  std::sort(closed_.begin(), closed_.end());
  return factor();
}

bool BasisVertex::exchange(int entering, int leaving) {
  *std::lower_bound(closed_.begin(), closed_.end(), entering) = leaving;
  std::sort(closed_.begin(), closed_.end());
  return factor();
}

bool BasisVertex::factor() {
  std::fill(is_basic_.begin(), is_basic_.end(), 1);
  for (const int column : closed_) is_basic_[at(column)] = 0;
  if (!cholesky_.factor(is_basic_)) return false;
  x_ = solution(structure_.load());
  // A row that was left out of the factor shows here.
  std::vector<double> left = product(structure_, x_);
  for (std::size_t i = 0; i < left.size(); ++i) left[i] -= structure_.load()[i];
  return largest_entry(left) <= tolerance::kPrimalResidual * std::max(1.0, largest_entry(x_));
}

std::vector<double> BasisVertex::solution(std::span<const double> load) const {
  std::vector<double> x(is_basic_.size(), 0);
  std::vector<double> left(load.begin(), load.end());
  const double enough = tolerance::kVertexRounding * largest_entry(left);
  for (int round = 0; round < kMostRounds && largest_entry(left) > enough; ++round) {
    cholesky_.solve(left);
    const std::vector<double> along = transposed_product(structure_, left);
    for (std::size_t k = 0; k < x.size(); ++k) x[k] += is_basic_[k] * along[k];
    left = product(structure_, x);
    for (std::size_t i = 0; i < left.size(); ++i) left[i] = load[i] - left[i];
  }
  return x;
}

std::vector<double> BasisVertex::direction(int entering) const {
  std::vector<double> unit(is_basic_.size(), 0);
  unit[at(entering)] = -1;
  std::vector<double> result = solution(product(structure_, unit));
  result[at(entering)] = 1;
  return result;
}

std::vector<double> BasisVertex::price(std::vector<double>& costs) const {
  std::vector<double> y(at(structure_.rows()), 0);
  std::vector<double> left(costs.size());
  const auto basic_costs = [&] {
    for (std::size_t k = 0; k < costs.size(); ++k) left[k] = is_basic_[k] * costs[k];
    return largest_entry(left);
  };
  const double enough = tolerance::kVertexRounding * largest_entry(costs);
  for (int round = 0; round < kMostRounds && basic_costs() > enough; ++round) {
    std::vector<double> step = product(structure_, left);
    cholesky_.solve(step);
    const std::vector<double> along = transposed_product(structure_, step);
    for (std::size_t k = 0; k < costs.size(); ++k) costs[k] -= along[k];
    for (std::size_t i = 0; i < y.size(); ++i) y[i] += step[i];
  }
  return y;
}

}  // namespace indet::barrier
