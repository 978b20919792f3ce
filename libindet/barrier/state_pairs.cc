#include "libindet/barrier/state_pairs.h"

#include <cmath>
#include <cstddef>
#include <utility>

#include "libindet/barrier/vectors.h"
#include "libindet/base/constants.h"
#include "libindet/base/rounding_bounds.h"

namespace indet::barrier {
namespace {

/// What an entry of B, or the product with one, may have been rounded by, relative to it.
constexpr double kForceRounding = 8 * kRoundoff;

/// ‖B x‖, or with `magnitudes` ‖|B| x‖.
double force_norm(const EquilibriumProblem& problem, std::span<const double> x, bool magnitudes = false) {
  double squares = 0;
  for (int k = 0; k < problem.unknowns();) {
    const Edge& edge = problem.edge(k);
    const int count = problem.is_stick(edge) ? 2 : 1;
    double R = 0, T = 0;
    for (int e = k; e < k + count; ++e) {
      R += problem.edge(e).R * x[index(e)];
      T += (magnitudes ? std::abs(problem.edge(e).T) : problem.edge(e).T) * x[index(e)];
    }
    squares += R * R + T * T;
    k += count;
  }
  return std::sqrt(squares);
}

std::vector<double> difference(std::span<const double> a, std::span<const double> b) {
  std::vector<double> result;
  for (std::size_t k = 0; k < a.size(); ++k) result.push_back(a[k] - b[k]);
  return result;
}

}  // namespace

StatePairs::StatePairs(const EquilibriumProblem& problem, std::span<const int> rows,
                       const BlockStructure& single, const AnalyticCentre& centre,
                       const VerifiedEquations& equations)
    : problem_(problem),
      single_(single),
      single_centre_(centre),
      equations_(equations),
      structure_(pair_system(problem, rows)) {
  centre_.found = true;
  centre_.x = centre.x;
  centre_.x.insert(centre_.x.end(), centre.x.begin(), centre.x.end());
  centre_.y.assign(index(structure_.rows()), 0);
  for (std::size_t place = 0; place < centre.y.size(); ++place) {
    const int equation = single.equation_of_place()[place];
    for (const int copy : {equation, equation + problem.equations()})
      centre_.y[index(structure_.place_of_equation()[index(copy)])] = centre.y[place];
  }
}

Objective StatePairs::objective(const Objective& c) const {
  Objective both = c;
  for (const auto& [column, weight] : c) both.emplace_back(column + problem_.unknowns(), -weight);
  return both;
}

StatePairs::Proof StatePairs::prove(const Objective& c, double g, const Iterate& iterate) const {
  const std::size_t n = single_centre_.x.size();
  Objective opposite = c;
  for (auto& [column, weight] : opposite) weight = -weight;
  Proof proof;

  const std::vector<double> x = equations_.repaired(iterate.x.first(n));
  const std::vector<double> other = equations_.repaired(iterate.x.last(n));
  proof.least = equations_.enclose(c, x, single_centre_.y).upper;
  proof.largest = -equations_.enclose(opposite, other, single_centre_.y).upper;
  proof.distance = kWiden * force_norm(problem_, difference(x, other));
  for (const std::vector<double>* point : {&x, &other}) {
    const auto [shift, share] = equations_.nearest_solution(*point);
    const double reach = shift + share * equations_.centre_shift();
    std::vector<double> sizes = *point;
    for (double& size : sizes) size = std::abs(size);
    proof.distance += kWiden * (share * force_norm(problem_, difference(single_centre_.x, *point)) +
                                (reach + kForceRounding) * force_norm(problem_, single_centre_.x, true) +
                                kForceRounding * force_norm(problem_, sizes, true));
  }

  // y, y' and z by their places, and the objectives that z leaves to each copy.
  std::vector<double> multipliers[2];
  for (const int copy : {0, 1}) {
    for (const int equation : single_.equation_of_place()) {
      const int place = structure_.place_of_equation()[index(equation + copy * problem_.equations())];
      multipliers[copy].push_back(iterate.y[index(place)]);
    }
  }
  std::vector<double> weights[2] = {std::vector<double>(n, 0.0), std::vector<double>(n, 0.0)};
  std::vector<double> sizes(n, 0.0);
  for (const auto& [column, weight] : c) {
    weights[0][index(column)] += weight;
    weights[1][index(column)] -= weight;
    sizes[index(column)] += std::abs(weight);
  }
  double squares = 0;
  for (const int place : structure_.elastic_rows())
    squares += iterate.y[index(place)] * iterate.y[index(place)];
  for (std::size_t k = 0; k < n; ++k) {
    const Edge& edge = problem_.edge(static_cast<int>(k));
    if (edge.is_slack()) continue;
    for (const int component : {0, 1}) {
      const int equation = 2 * problem_.equations() + 2 * edge.contact.value() + component;
      const int place = structure_.place_of_equation()[index(equation)];
      if (place < 0) continue;
      const double part = (component == 0 ? edge.R : edge.T) * iterate.y[index(place)];
      weights[0][k] -= part;
      weights[1][k] += part;
      sizes[k] += std::abs(part);
    }
  }
  Objective left[2];
  double rounding = 0;
  for (std::size_t k = 0; k < n; ++k) {
    for (const int copy : {0, 1}) left[copy].emplace_back(static_cast<int>(k), weights[copy][k]);
    rounding += 2 * kForceRounding * sizes[k] * equations_.strength_bounds()[k];
  }
  const double lower[2] = {equations_.lower_bound(left[0], multipliers[0]),
                           equations_.lower_bound(left[1], multipliers[1])};
  const double price = g * squares / 2;
  proof.dual = lower[0] + lower[1] - kWiden * (price + rounding) -
               kForceRounding * (std::abs(lower[0]) + std::abs(lower[1]));
  return proof;
}

}  // namespace indet::barrier
