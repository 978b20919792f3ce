#include "libindet/polytope/unbounded_polytope.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "libindet/polytope/motion_rows.h"

namespace indet {
namespace {

/// The problem without load, and with the edges of a ray alone.
EquilibriumProblem without_load(const EquilibriumProblem& problem, const Eigen::VectorXd& ray) {
  EquilibriumProblem cone = problem;
  cone.right_hand_sides.setZero();
  for (EquilibriumRow& row : cone.rows) row.load = 0;
  std::vector<ContactMode> modes = problem.modes;
  std::vector<int> closed_bounds;
  for (int k = 0; k < problem.unknowns(); ++k) {
    if (ray[k] > 0) continue;
    const Edge& edge = problem.edge(k);
    if (edge.is_slack()) {
      closed_bounds.push_back(edge.bound);
      continue;
    }
    ContactMode& mode = modes[static_cast<std::size_t>(edge.contact.value())];
    mode = without_edge(mode, edge.sign);
  }
  return restrict_modes(cone, modes, closed_bounds);
}

/// Those rows of the cone's problem that are among the given ones of the whole and that some edge enters.
/// Both have them in one order.
std::vector<int> rows_in_cone(const EquilibriumProblem& cone, const EquilibriumProblem& problem,
                              std::span<const int> rows) {
  const auto is_same = [](const EquilibriumRow& a, const EquilibriumRow& b) {
    return a.body == b.body && a.component == b.component && a.bound == b.bound;
  };
  std::vector<bool> is_entered(static_cast<std::size_t>(cone.equations()), false);
  for (int k = 0; k < cone.edge_matrix.outerSize(); ++k) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(cone.edge_matrix, k); it; ++it)
      if (it.value() != 0) is_entered[static_cast<std::size_t>(it.row())] = true;
  }
  std::vector<int> result;
  int whole = 0;
  for (int row = 0; row < cone.equations(); ++row) {
    while (!is_same(problem.rows[static_cast<std::size_t>(whole)], cone.rows[static_cast<std::size_t>(row)]))
      ++whole;
    if (is_entered[static_cast<std::size_t>(row)] && std::binary_search(rows.begin(), rows.end(), whole))
      result.push_back(row);
  }
  return result;
}

std::vector<int> all_edges(const EquilibriumProblem& problem) {
  std::vector<int> edges(static_cast<std::size_t>(problem.unknowns()));
  std::iota(edges.begin(), edges.end(), 0);
  return edges;
}

}  // namespace

UnboundedPolytope::UnboundedPolytope(EquilibriumProblem of_cone, std::span<const int> rows_of_cone)
    : cone_problem(std::move(of_cone)),
      cone(cone_problem, rows_of_cone,
           {all_edges(cone_problem), static_cast<double>(cone_problem.unknowns())}) {}

std::shared_ptr<const UnboundedPolytope> find_unbounded_polytope(const EquilibriumProblem& problem,
                                                                 std::span<const int> rows,
                                                                 std::span<const double> state,
                                                                 const Eigen::VectorXd& ray) {
  EquilibriumProblem cone = without_load(problem, ray);
  const std::vector<int> cone_rows = rows_in_cone(cone, problem, rows);
  const auto result = std::make_shared<UnboundedPolytope>(std::move(cone), cone_rows);
  if (!result->cone.is_proven()) return {};
  result->rows.assign(rows.begin(), rows.end());
  for (int k = 0; k < problem.unknowns(); ++k) {
    if (!(ray[k] > 0)) continue;
    result->unlimited.push_back(k);
    result->total += state[static_cast<std::size_t>(k)];
  }
  // Within a limit that is too narrow, the bounds of the other edges are lost.
  for (const double factor : {1e0, 1e1, 1e2, 1e3, 1e5}) {
    result->within = limited_polytope(problem, *result, factor);
    if (result->within->is_proven()) return result;
  }
  return {};
}

std::shared_ptr<const CentralPolytope> limited_polytope(const EquilibriumProblem& problem,
                                                        const UnboundedPolytope& polytope, double factor) {
  return std::make_shared<const CentralPolytope>(problem, polytope.rows,
                                                 barrier::Limit{polytope.unlimited, factor * polytope.total});
}

}  // namespace indet
