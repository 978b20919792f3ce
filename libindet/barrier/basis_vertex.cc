#include "libindet/barrier/basis_vertex.h"

#include <algorithm>
#include <numeric>

#include "libindet/barrier/block_cholesky.h"
#include "libindet/barrier/vectors.h"
#include "libindet/base/tolerances.h"

namespace indet::barrier {
namespace {

constexpr int kMostRounds = 4;
/// A column is well independent of others from this share of the most independent one on.
constexpr double kIndependent = 1e-3;
/// With more columns to replace a basis is a poor proposal.
constexpr std::size_t kMostDependent = 20;

}  // namespace

BasisVertex::BasisVertex(const BlockStructure& structure)
    : structure_(structure), factor_(structure), place_(index(structure.columns()), -1) {}

bool BasisVertex::set_basis(std::span<const double> rank) {
  std::vector<int> order(rank.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return rank[index(a)] > rank[index(b)]; });
  std::vector<int> basis(order.begin(), order.begin() + structure_.rows());
  std::sort(basis.begin(), basis.end());
  std::vector<int> dependent;  // places
  for (auto next = factor_.factor(basis); next; next = factor_.factor(basis)) {
    if (dependent.size() == kMostDependent) return false;
    basis[index(next->column)] = factor_.unit_column(next->row);
    dependent.push_back(next->column);
  }
  std::fill(place_.begin(), place_.end(), -1);
  for (std::size_t p = 0; p < basis.size(); ++p) {
    if (basis[p] < factor_.unit_column(0)) place_[index(basis[p])] = static_cast<int>(p);
  }
  for (const int p : dependent) {
    if (!take_independent(p, order)) return false;
  }
  closed_.clear();
  for (std::size_t k = 0; k < place_.size(); ++k) {
    if (place_[k] < 0) closed_.push_back(static_cast<int>(k));
  }
  return true;
}

/// The first column of the order that is independent of all but the one at a place comes there.
bool BasisVertex::take_independent(int place, const std::vector<int>& order) {
  std::vector<double> y(index(structure_.rows()), 0);
  y[index(place)] = 1;
  factor_.solve_transposed(y);
  const std::vector<double> along = transposed_product(structure_, y);
  const double enough = kIndependent * largest_entry(along);
  for (const int column : order) {
    if (is_basic(column) || std::abs(along[index(column)]) < enough) continue;
    place_[index(column)] = place;
    return factor_.replace(place, column, places_along(column));
  }
  return false;
}

std::vector<double> BasisVertex::places_along(int column) const {
  std::vector<double> unit(place_.size(), 0);
  unit[index(column)] = 1;
  std::vector<double> along = product(structure_, unit);
  factor_.solve(along);
  return along;
}

bool BasisVertex::exchange(int entering, int leaving, const std::vector<double>& along) {
  std::vector<double> of_places;
  for (const int column : factor_.basis()) of_places.push_back(-along[index(column)]);
  *std::lower_bound(closed_.begin(), closed_.end(), entering) = leaving;
  std::sort(closed_.begin(), closed_.end());
  std::swap(place_[index(entering)], place_[index(leaving)]);
  return factor_.replace(place_[index(entering)], entering, of_places);
}

std::optional<std::vector<double>> BasisVertex::solution(std::span<const double> load) const {
  std::vector<double> x(place_.size(), 0);
  std::vector<double> left(load.begin(), load.end());
  const double size = largest_entry(left);
  for (int round = 0; round < kMostRounds && largest_entry(left) > tolerance::kVertexRounding * size;
       ++round) {
    factor_.solve(left);
    for (std::size_t p = 0; p < left.size(); ++p) x[index(factor_.basis()[p])] += left[p];
    left = product(structure_, x);
    for (std::size_t i = 0; i < left.size(); ++i) left[i] = load[i] - left[i];
  }
  if (!(largest_entry(left) <= tolerance::kPrimalResidual * std::max(size, largest_entry(x)))) return {};
  return x;
}

std::vector<double> BasisVertex::direction(int entering) const {
  std::vector<double> result(place_.size(), 0);
  const std::vector<double> along = places_along(entering);
  for (std::size_t p = 0; p < along.size(); ++p) result[index(factor_.basis()[p])] = -along[p];
  result[index(entering)] = 1;
  return result;
}

std::vector<double> BasisVertex::row(int basic) const {
  std::vector<double> y(index(structure_.rows()), 0);
  y[index(place_[index(basic)])] = -1;
  factor_.solve_transposed(y);
  std::vector<double> rates = transposed_product(structure_, y);
  for (const int column : factor_.basis()) rates[index(column)] = column == basic ? 1 : 0;
  return rates;
}

std::vector<double> BasisVertex::price(std::vector<double>& costs) const {
  std::vector<double> y(index(structure_.rows()), 0);
  std::vector<double> left(y.size());
  const auto basic_costs = [&] {
    for (std::size_t p = 0; p < left.size(); ++p) left[p] = costs[index(factor_.basis()[p])];
    return largest_entry(left);
  };
  const double enough = tolerance::kVertexRounding * largest_entry(costs);
  for (int round = 0; round < kMostRounds && basic_costs() > enough; ++round) {
    factor_.solve_transposed(left);
    const std::vector<double> along = transposed_product(structure_, left);
    for (std::size_t k = 0; k < costs.size(); ++k) costs[k] -= along[k];
    for (std::size_t i = 0; i < y.size(); ++i) y[i] += left[i];
  }
  return y;
}

}  // namespace indet::barrier
