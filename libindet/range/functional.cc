#include "libindet/range/functional.h"

#include <cmath>

#include "libindet/base/rounding_bounds.h"

namespace indet {
namespace {

/// on_R R + on_T T on an edge, κ (on_R ± μ on_T). Of the sum of on_R and the two parts of a product, the low
/// part alone is rounded, and where the high ones cancel it is not.
Doubled coefficient(const EquilibriumProblem& problem, const Edge& edge, double on_R, double on_T) {
  DoubledSum direction;
  direction.add(on_R);
  if (edge.sign != 0) direction.add_product(edge.sign * problem.mu(edge), on_T);
  return product(direction.doubled(), edge.R);
}

/// Calls visit(k, edge) for the edges of a contact.
template <class Visit>
void for_each_edge(const EquilibriumProblem& problem, const std::vector<int>& first, Eigen::Index contact,
                   Visit visit) {
  const int start = first[static_cast<std::size_t>(contact)];
  if (start < 0) return;
  const int edges = problem.is_stick(problem.edge(start)) ? 2 : 1;
  for (int k = start; k < start + edges; ++k) visit(k, problem.edge(k));
}

/// Calls visit(k, edge, on_R, on_T) for all edges on which a sum is not 0.
template <class Visit>
void for_each_summand(const EquilibriumProblem& problem, const Eigen::VectorXd& on_forces, Visit visit) {
  for (int k = 0; k < problem.unknowns(); ++k) {
    const Edge& edge = problem.edge(k);
    if (edge.is_slack()) continue;
    const double on_R = on_forces[2 * edge.contact.value()];
    const double on_T = on_forces[2 * edge.contact.value() + 1];
    if (on_R != 0 || on_T != 0) visit(k, edge, on_R, on_T);
  }
}

}  // namespace

Functional force_component(const EquilibriumProblem& problem, const std::vector<int>& first,
                           Eigen::Index contact, bool tangential, double sign) {
  Functional f;
  for_each_edge(problem, first, contact,
                [&](int k, const Edge& edge) { f.emplace_back(k, sign * (tangential ? edge.T : edge.R)); });
  return f;
}

DoubledFunctional doubled_component(const EquilibriumProblem& problem, const std::vector<int>& first,
                                    Eigen::Index contact, bool tangential, double sign) {
  DoubledFunctional f;
  for_each_edge(problem, first, contact, [&](int k, const Edge& edge) {
    f.emplace_back(k, coefficient(problem, edge, tangential ? 0 : sign, tangential ? sign : 0));
  });
  return f;
}

Functional sum_of_forces(const EquilibriumProblem& problem, const Eigen::VectorXd& on_forces) {
  Functional f;
  for_each_summand(problem, on_forces, [&](int k, const Edge& edge, double on_R, double on_T) {
    f.emplace_back(k, on_R * edge.R + on_T * edge.T);
  });
  return f;
}

DoubledFunctional doubled_sum(const EquilibriumProblem& problem, const Eigen::VectorXd& on_forces) {
  DoubledFunctional f;
  for_each_summand(problem, on_forces, [&](int k, const Edge& edge, double on_R, double on_T) {
    f.emplace_back(k, coefficient(problem, edge, on_R, on_T));
  });
  return f;
}

double rounding_of_sum(const EquilibriumProblem& problem, const Eigen::VectorXd& on_forces,
                       const std::vector<double>& strength) {
  double sum = 0;
  for_each_summand(problem, on_forces, [&](int k, const Edge& edge, double on_R, double on_T) {
    sum += (std::abs(on_R * edge.R) + std::abs(on_T * edge.T)) * strength[static_cast<std::size_t>(k)];
  });
  // Each is a sum of two products with rounded factors.
  return sum == 0 ? 0 : 5 * kRoundoff * sum + kTiny;
}

DoubledFunctional opposite(DoubledFunctional functional) {
  for (auto& [k, coefficient] : functional) coefficient = {-coefficient.high, -coefficient.low};
  return functional;
}

}  // namespace indet
