#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "bench/methods/rivals.h"
#include "libindet/base/random.h"
#include "libindet/lp/layout.h"
#include "libindet/lp/vertex.h"

namespace indet::bench {

std::vector<Objective> natural_objectives(const ForcePolytope& polytope, const PolytopeBlock& block) {
  std::map<int, std::pair<std::vector<std::pair<int, double>>, std::vector<std::pair<int, double>>>> contacts;
  for (std::size_t k = 0; k < block.edges.size(); ++k) {
    const Edge& edge = polytope.problem.edges[static_cast<std::size_t>(block.edges[k])];
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
        objectives.push_back(make_objective(block.view, on_edges));
      }
    }
  }
  return objectives;
}

Tally plain_glpk(const ForcePolytope& polytope, Formulation formulation, Start start, bool by_chance,
                 const LpOptions& options) {
  Tally tally;
  for (const PolytopeBlock& block : polytope.blocks) {
    const auto layout = make_layout(block.view, formulation);
    const auto problem = layout->build();
    layout->set_start(*problem, block.lightest);
    GlpkProblem::Settings settings;
    settings.simplex = layout->warm_simplex();
    settings.feasibility = options.feasibility;
    settings.optimality = options.optimality;
    settings.keep_factors = start == Start::kLastOptimum;
    if (settings.keep_factors) settings.iteration_limit = 20 * block.view.dim() + 200;
    const std::vector<Objective> objectives = natural_objectives(polytope, block);
    std::vector<std::size_t> order(objectives.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    Random random(1);
    for (std::size_t i = 0; by_chance && i < order.size(); ++i)
      std::swap(order[i], order[i + random.below(order.size() - i)]);
    std::vector<double> optima(objectives.size());
    std::vector<double> raw(objectives.size());
    for (const std::size_t i : order) {
      const Objective& objective = objectives[i];
      layout->set_objective(*problem, objective);
      if (start == Start::kFirstVertex) layout->set_start(*problem, block.lightest);
      if (start == Start::kScratch) problem->advanced_basis();
      GlpkProblem::Result result = problem->solve(settings);
      tally.pivots += problem->pivots();
      if (result == GlpkProblem::Result::kLimit) {  // old factors can keep GLPK at an optimum for ever
        GlpkProblem::Settings anew = settings;
        anew.keep_factors = false;
        anew.iteration_limit = options.iteration_limit;
        result = problem->solve(anew);
        tally.pivots += problem->pivots();
      }
      if (layout->interpret(result) != LpStatus::kOptimal) throw std::runtime_error("GLPK: a solve failed");
      ++tally.solves;
      const Vertex vertex = compute_vertex(block.view, layout->read_basis(*problem));
      for (const auto& [index, coefficient] : objective.on_edges) optima[i] += coefficient * vertex.x[index];
      // The edge formulation alone has the objective without a constant term.
      raw[i] = formulation == Formulation::kEdge ? problem->objective_value() : std::nan("");
    }
    tally.optima.insert(tally.optima.end(), optima.begin(), optima.end());
    tally.raw.insert(tally.raw.end(), raw.begin(), raw.end());
  }
  return tally;
}

}  // namespace indet::bench
