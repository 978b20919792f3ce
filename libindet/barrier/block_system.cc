#include "libindet/barrier/block_system.h"

#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

#include "libindet/barrier/vectors.h"

namespace indet::barrier {
namespace {

/// The nodes of these equations: those of bodies by their body, of bounds by their contact.
std::vector<BlockSystem::Node> collect_nodes(const EquilibriumProblem& problem, std::span<const int> rows) {
  std::map<std::pair<int, int>, std::vector<int>> equations;
  for (const int row : rows) {
    const EquilibriumRow& equation = problem.rows[index(row)];
    const bool is_bound = equation.bound >= 0;
    const int name =
        is_bound ? problem.bounds[index(equation.bound)].bound.contact.value() : equation.body.code();
    equations[{is_bound ? 1 : 0, name}].push_back(row);
  }
  std::vector<BlockSystem::Node> nodes;
  for (auto& [name, list] : equations) {
    const EquilibriumRow& first = problem.rows[index(list.front())];
    const bool is_last = first.bound < 0 && (first.body.is_wall() || first.body.is_cell());
    nodes.push_back({std::move(list), is_last, false});
  }
  return nodes;
}

/// A node of one row, a part more of each group with a column in it, and the group of the slack.
void add_limit(Limit limit, BlockSystem& system) {
  const auto node = static_cast<int>(system.nodes.size());
  system.nodes.push_back({{static_cast<int>(system.load.size())}, true, false});
  system.load.push_back(limit.total);
  int column = 0;
  auto next = limit.columns.begin();
  for (BlockSystem::Group& group : system.groups) {
    std::vector<double> entries(index(group.columns), 0.0);
    const auto first = next;
    for (; next != limit.columns.end() && *next < column + group.columns; ++next)
      entries[index(*next - column)] = 1;
    if (next != first) group.parts.push_back({node, std::move(entries)});
    column += group.columns;
  }
  system.groups.push_back({1, {{node, {1.0}}}});
  system.limit = std::move(limit);
}

}  // namespace

BlockSystem block_system(const EquilibriumProblem& problem, std::span<const int> rows, Limit limit) {
  BlockSystem system;
  system.nodes = collect_nodes(problem, rows);
  for (int row = 0; row < problem.equations(); ++row) system.load.push_back(problem.load()[row]);

  struct Place {
    int node = -1;  ///< −1: the equation is left out
    int row = 0;
  };
  std::vector<Place> places(index(problem.equations()));
  for (std::size_t node = 0; node < system.nodes.size(); ++node) {
    int row = 0;
    for (const int equation : system.nodes[node].equations)
      places[index(equation)] = {static_cast<int>(node), row++};
  }
  for (int column = 0; column < problem.unknowns();) {
    const int count = problem.is_stick(problem.edge(column)) ? 2 : 1;
    std::map<int, std::vector<double>> parts;
    for (int k = 0; k < count; ++k) {
      for (Eigen::SparseMatrix<double>::InnerIterator it(problem.edge_matrix, column + k); it; ++it) {
        const auto [node, row] = places[static_cast<std::size_t>(it.row())];
        if (node < 0) continue;
        const std::size_t size = system.nodes[index(node)].equations.size();
        std::vector<double>& coefficients = parts[node];
        coefficients.resize(index(count) * size, 0.0);
        coefficients[index(k) * size + index(row)] += it.value();
      }
    }
    BlockSystem::Group& group = system.groups.emplace_back();
    group.columns = count;
    for (auto& [node, coefficients] : parts) group.parts.push_back({node, std::move(coefficients)});
    column += count;
  }
  if (!limit.columns.empty()) add_limit(std::move(limit), system);
  return system;
}

BlockSystem pair_system(const EquilibriumProblem& problem, std::span<const int> rows) {
  BlockSystem system = block_system(problem, rows);
  const auto nodes = static_cast<int>(system.nodes.size());
  const std::size_t groups = system.groups.size();
  const int equations = problem.equations();
  for (int node = 0; node < nodes; ++node) {
    BlockSystem::Node copy = system.nodes[index(node)];
    for (int& equation : copy.equations) equation += equations;
    system.nodes.push_back(std::move(copy));
  }
  for (std::size_t k = 0; k < groups; ++k) {
    BlockSystem::Group copy = system.groups[k];
    for (BlockSystem::Part& part : copy.parts) part.node += nodes;
    system.groups.push_back(std::move(copy));
  }
  system.load.insert(system.load.end(), system.load.begin(), system.load.end());
  system.load.resize(2 * index(equations) + 2 * problem.contacts.size(), 0.0);

  int column = 0;
  for (std::size_t k = 0; k < groups; ++k) {
    BlockSystem::Group& group = system.groups[k];
    const Edge& edge = problem.edge(column);
    if (!edge.is_slack()) {
      const int first = 2 * equations + 2 * edge.contact.value();
      const bool has_friction = edge.T != 0;
      const auto node = static_cast<int>(system.nodes.size());
      system.nodes.push_back(
          {has_friction ? std::vector<int>{first, first + 1} : std::vector<int>{first}, false, true});
      std::vector<double> forces, opposite;
      for (int e = 0; e < group.columns; ++e) {
        forces.push_back(problem.edge(column + e).R);
        if (has_friction) forces.push_back(problem.edge(column + e).T);
      }
      for (const double force : forces) opposite.push_back(-force);
      group.parts.push_back({node, std::move(forces)});
      system.groups[groups + k].parts.push_back({node, std::move(opposite)});
    }
    column += group.columns;
  }
  return system;
}

}  // namespace indet::barrier
