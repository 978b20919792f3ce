// Time of all force ranges of packings, ours against rivals, alternating within one run. CPU time of the
// calling thread, so that other work on the machine counts little.
//   bench_ranges [--repeat N] P.h5 …        prints one JSON document

#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string>
#include <vector>

#include "indet/io/packing_file.h"
#include "indet/range/analyze.h"
#include "indet/range/extremal_search.h"
#include "rivals.h"

namespace indet::bench {
namespace {

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Our search with everything that it certifies, in the order of natural_objectives.
Tally our_search(const ForcePolytope& polytope, Formulation formulation, bool canonical) {
  Tally tally;
  for (const PolytopeBlock& block : polytope.blocks) {
    std::vector<Component> components;
    const std::vector<Objective> objectives = natural_objectives(polytope, block);
    for (std::size_t i = 1; i < objectives.size(); i += 2)
      components.push_back({objectives[i].on_edges, true, true});
    Eigen::VectorXd weight(static_cast<Eigen::Index>(block.edges.size()));
    for (std::size_t k = 0; k < block.edges.size(); ++k) {
      weight[static_cast<Eigen::Index>(k)] =
          polytope.contacts.edges[static_cast<std::size_t>(block.edges[k])].R;
    }
    SearchOptions options;
    options.formulation = formulation;
    options.canonical_states = canonical;
    const SearchResult found = search_extrema(block.set, components, weight, block.lightest, options);
    tally.solves += found.solves;
    tally.pivots += found.pivots;
    for (std::size_t c = 0; c < components.size(); ++c) {
      tally.optima.push_back(-found.minimum[c].value);
      tally.optima.push_back(found.maximum[c].value);
    }
  }
  return tally;
}

struct Method {
  std::string name;
  std::function<std::optional<Tally>(const ForcePolytope&)> run;
};

std::vector<Method> all_methods() {
  std::vector<Method> methods;
  for (const Formulation formulation : {Formulation::kNullSpace, Formulation::kDual, Formulation::kEdge}) {
    const std::string name = to_string(formulation);
    methods.push_back(
        {"indet " + name, [=](const ForcePolytope& p) { return our_search(p, formulation, false); }});
    methods.push_back({"indet " + name + ", canonical states",
                       [=](const ForcePolytope& p) { return our_search(p, formulation, true); }});
    methods.push_back({"natural order " + name,
                       [=](const ForcePolytope& p) { return natural_order_glpk(p, formulation); }});
  }
  methods.push_back({"natural order Clp", natural_order_clp});
  return methods;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

nlohmann::json measure(const std::string& file, int repeat) {
  const Packing packing = read_packing(file);
  const ForcePolytope polytope = find_force_polytope(packing);
  nlohmann::json result = {{"file", file},
                           {"disks", packing.disk_count()},
                           {"contacts", packing.contact_count()},
                           {"dim", polytope.dim}};
  if (polytope.status != PolytopeStatus::kBounded) return result;
  const std::vector<Method> methods = all_methods();
  std::map<std::string, std::vector<double>> seconds;
  std::map<std::string, Tally> tallies;
  for (int i = 0; i < repeat; ++i) {
    for (const Method& method : methods) {
      const double start = cpu_seconds();
      const std::optional<Tally> tally = method.run(polytope);
      if (!tally) continue;
      seconds[method.name].push_back(cpu_seconds() - start);
      tallies[method.name] = *tally;
    }
  }
  const std::vector<double>& reference = tallies.at("indet edge").optima;
  for (const Method& method : methods) {
    if (!tallies.contains(method.name)) continue;
    const Tally& tally = tallies[method.name];
    double worst = 0;
    for (std::size_t i = 0; i < reference.size(); ++i)
      worst = std::max(worst, std::abs(tally.optima[i] - reference[i]));
    result["methods"][method.name] = {{"seconds", median(seconds[method.name])},
                                      {"all_seconds", seconds[method.name]},
                                      {"solves", tally.solves},
                                      {"pivots", tally.pivots},
                                      {"largest_difference", worst}};
  }
  return result;
}

}  // namespace
}  // namespace indet::bench

int main(int argc, char** argv) {
  int repeat = 3;
  std::vector<std::string> files;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--repeat" && i + 1 < argc) {
      repeat = std::max(1, std::stoi(argv[++i]));
    } else {
      files.push_back(argument);
    }
  }
  nlohmann::json document = nlohmann::json::array();
  for (const std::string& file : files) document.push_back(indet::bench::measure(file, repeat));
  std::cout << document.dump(1) << '\n';
  return files.empty() ? 2 : 0;
}
