// What the parts of a range search cost on this machine, for profile.py.
//   bench_profile P.h5                          prints one JSON document
//
// A solve that starts from its optimum makes no pivot: what it takes is GLPK's set-up and, where it does not
// go on from where GLPK stands, its factorisation of the start basis. The rate is that of dense arithmetic in
// cache, a product of matrices, and the rank-one change of a tableau.

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/methods/rivals.h"
#include "libindet/io/packing_file.h"
#include "libindet/lp/lp_solver.h"
#include "libindet/pivoting/tableau_solver.h"
#include "libindet/range/analyze.h"
#include "libindet/range/extremal_search.h"

namespace indet::bench {
namespace {

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Seconds a call, over at least a fifth of a second.
template <class Work>
double seconds_of(Work work) {
  const double begin = now();
  std::int64_t calls = 0;
  for (; now() - begin < 0.2; ++calls) work();
  return (now() - begin) / static_cast<double>(calls);
}

double product_rate() {
  constexpr int kSize = 192;
  const Eigen::MatrixXd a = Eigen::MatrixXd::Constant(kSize, kSize, 0.5);
  Eigen::MatrixXd b = a;
  const double seconds = seconds_of([&] { b.noalias() = a * a; });
  return 2.0 * kSize * kSize * kSize / seconds;
}

/// Seconds a pivot of the tableau, over solves of all objectives from one vertex.
double tableau_pivot_seconds(const SlopeView& view, const std::vector<Objective>& objectives,
                             const Basis& start) {
  TableauSolver solver(view);
  std::int64_t pivots = 0;
  const double begin = now();
  for (const Objective& objective : objectives) pivots += solver.maximise(objective, start).pivots;
  return (now() - begin) / static_cast<double>(std::max<std::int64_t>(1, pivots));
}

/// Of the solves of a search, those that go on with the factors of the one before.
double continued_fraction(const ForcePolytope& polytope, Formulation formulation, bool canonical_states) {
  const PolytopeBlock& block = polytope.blocks.at(0);
  std::vector<Component> components;
  const std::vector<Objective> objectives = natural_objectives(polytope, block);
  for (std::size_t i = 1; i < objectives.size(); i += 2)
    components.push_back({objectives[i].on_edges, true, true});
  Eigen::VectorXd weight(static_cast<Eigen::Index>(block.edges.size()));
  for (std::size_t k = 0; k < block.edges.size(); ++k) {
    weight[static_cast<Eigen::Index>(k)] = polytope.problem.edges[static_cast<std::size_t>(block.edges[k])].R;
  }
  SearchOptions options;
  options.formulation = formulation;
  options.canonical_states = canonical_states;
  const SearchResult found = search_extrema(block.view, components, weight, block.lightest, options);
  return static_cast<double>(found.continued) / static_cast<double>(std::max<std::int64_t>(1, found.solves));
}

nlohmann::json measure(const std::string& file) {
  const double read_seconds = seconds_of([&] { read_packing(file); });
  const Packing packing = read_packing(file);
  const ForcePolytope polytope = find_force_polytope(packing);
  const PolytopeBlock& block = polytope.blocks.at(0);
  const Formulation formulation = choose_formulation(block.view.dim());
  std::vector<Objective> objectives = natural_objectives(polytope, block);
  LpSolver solver(block.view, formulation);
  std::vector<Basis> optima;
  for (const Objective& objective : objectives)
    optima.push_back(solver.maximise(objective, optima.empty() ? block.lightest : optima.back()).basis);
  const auto at_optima = [&](auto work) {
    std::size_t i = 0;
    return seconds_of([&] {
      work(i);
      i = (i + 1) % optima.size();
    });
  };
  const double resolve = at_optima([&](std::size_t i) { solver.maximise(objectives[i], optima[i]); });
  const double going_on = at_optima([&](std::size_t) { solver.maximise(objectives.back(), optima.back()); });
  const double vertex = at_optima([&](std::size_t i) { compute_vertex(block.view, optima[i]); });
  return {{"inequalities", block.view.inequalities()},
          {"dim", block.view.dim()},
          {"formulation", to_string(formulation)},
          {"read_seconds", read_seconds},
          {"start_seconds", resolve},
          {"going_on_seconds", going_on},
          {"going_on",
           {{"fast", continued_fraction(polytope, formulation, false)},
            {"standard", continued_fraction(polytope, formulation, true)}}},
          {"vertex_seconds", vertex},
          {"tableau_pivot_seconds", tableau_pivot_seconds(block.view, objectives, block.lightest)},
          {"product_flops_per_second", product_rate()}};
}

}  // namespace
}  // namespace indet::bench

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "bench_profile P.h5\n";
    return 2;
  }
  try {
    std::cout << indet::bench::measure(argv[1]).dump(1) << '\n';
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "bench_profile: " << error.what() << '\n';
    return 1;
  }
}
