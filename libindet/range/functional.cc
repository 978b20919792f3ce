#include "libindet/range/functional.h"

#include <algorithm>

#include "libindet/base/rounding_bounds.h"

namespace indet {

double Functional::at(const Eigen::VectorXd& u) const {
  double value = 0;
  for (const auto& [unknown, coefficient] : on_unknowns) value += coefficient * u[unknown];
  return value;
}

double Functional::rounding(const std::vector<double>& strength) const {
  double sum = 0;
  for (std::size_t k = 0; k < on_edges.size(); ++k)
    sum += edge_size(k) * strength[static_cast<std::size_t>(on_edges[k].first)];
  // Each is a sum of two products with rounded factors.
  return sum == 0 ? 0 : 5 * kRoundoff * sum + kTiny;
}

Functional Functional::opposite() const {
  Functional f = *this;
  for (auto* part : {&f.on_unknowns, &f.on_edges}) {
    for (auto& entry : *part) entry.second = -entry.second;
  }
  return f;
}

Functional sum_of_forces(const EquilibriumProblem& problem, const Eigen::VectorXd& on_forces) {
  Functional f;
  for (int k = 0; k < problem.unknowns(); ++k) {
    const Edge& edge = problem.edge(k);
    if (edge.is_slack()) continue;
    const double on_R = on_forces[2 * edge.contact.value()];
    const double on_T = on_forces[2 * edge.contact.value() + 1];
    if (on_R == 0 && on_T == 0) continue;
    f.on_edges.emplace_back(k, on_R * edge.R + on_T * edge.T);
    f.edge_sizes.push_back(std::abs(on_R * edge.R) + std::abs(on_T * edge.T));
    if (problem.is_stick(edge)) {  // its unknowns are R, then T
      f.on_unknowns.emplace_back(k, edge.sign > 0 ? on_R : on_T);
      f.unknown_sizes.push_back(std::abs(f.on_unknowns.back().second));
    } else {
      f.on_unknowns.push_back(f.on_edges.back());
      f.unknown_sizes.push_back(f.edge_sizes.back());
    }
  }
  return f;
}

Functional force_component(const EquilibriumProblem& problem, const std::vector<int>& first,
                           Eigen::Index contact, bool tangential, double sign) {
  Functional f;
  const int start = first[static_cast<std::size_t>(contact)];
  if (start < 0) return f;
  const int edges = problem.is_stick(problem.edge(start)) ? 2 : 1;
  for (int k = start; k < start + edges; ++k) {
    const Edge& edge = problem.edge(k);
    const double coefficient = sign * (tangential ? edge.T : edge.R);
    f.on_edges.emplace_back(k, coefficient);
    if (edges == 1) f.on_unknowns.emplace_back(k, coefficient);
  }
  if (edges == 2) f.on_unknowns.emplace_back(start + (tangential ? 1 : 0), sign);
  return f;
}

Objective objective_on(const PolytopeBlock& block, const Functional& f) {
  std::vector<std::pair<int, double>> on_edges;
  for (const auto& [edge, coefficient] : f.on_edges) {
    const auto local = std::lower_bound(block.edges.begin(), block.edges.end(), edge);
    if (local != block.edges.end() && *local == edge)
      on_edges.emplace_back(static_cast<int>(local - block.edges.begin()), coefficient);
  }
  return make_objective(block.view, std::move(on_edges));
}

}  // namespace indet
