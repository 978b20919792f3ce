#include <map>
#include <memory>
#include <stdexcept>

#include "indet/lp/layout.h"
#include "indet/lp/vertex.h"
#include "rivals.h"

namespace indet::bench {
std::vector<Objective> natural_objectives(const ForcePolytope& polytope, const PolytopeBlock& block) {
  std::map<int, std::pair<std::vector<std::pair<int, double>>, std::vector<std::pair<int, double>>>> contacts;
  for (std::size_t k = 0; k < block.edges.size(); ++k) {
    const Edge& edge = polytope.contacts.edges[static_cast<std::size_t>(block.edges[k])];
    auto& [normal, tangential] = contacts[edge.contact.value()];
    normal.emplace_back(static_cast<int>(k), edge.R);
    if (edge.T != 0) tangential.emplace_back(static_cast<int>(k), edge.T);
  }
  std::vector<Objective> objectives;
  for (const auto& [contact, pair] : contacts) {
    for (const auto* component : {&pair.first, &pair.second}) {
      for (const double sign : {-1.0, 1.0}) {
        if (component->empty()) continue;
        auto on_edges = *component;
        for (auto& [index, coefficient] : on_edges) coefficient *= sign;
        objectives.push_back(make_objective(block.set, on_edges));
      }
    }
  }
  return objectives;
}

Tally natural_order_glpk(const ForcePolytope& polytope, Formulation formulation) {
  Tally tally;
  for (const PolytopeBlock& block : polytope.blocks) {
    const auto layout = make_layout(block.set, formulation);
    const auto problem = layout->build();
    layout->set_start(*problem, block.lightest);
    GlpkProblem::Settings settings;
    settings.method = layout->warm_method();
    settings.feasibility = tolerance::kLpFeasibility;
    settings.optimality = tolerance::kLpOptimality;
    settings.keep_factors = true;
    for (const Objective& objective : natural_objectives(polytope, block)) {
      layout->set_objective(*problem, objective);
      if (layout->interpret(problem->solve(settings)) != LpStatus::kOptimal)
        throw std::runtime_error("GLPK: a solve failed");
      ++tally.solves;
      tally.pivots += problem->pivots();
      const Vertex vertex = compute_vertex(block.set, layout->read_basis(*problem));
      double value = 0;
      for (const auto& [index, coefficient] : objective.on_edges) value += coefficient * vertex.x[index];
      tally.optima.push_back(value);
    }
  }
  return tally;
}

}  // namespace indet::bench
