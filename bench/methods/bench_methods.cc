// All force ranges of one packing by one method, in a process of its own.
//   bench_methods --list                        prints the names of the methods
//   bench_methods METHOD P.h5 [TOLERANCE]       prints one JSON document; the tolerance is that of GLPK
//
// Seconds are CPU time of the thread that does all the work. They begin when the polytope is known, whose
// time is given apart: all methods share it. Memory is the largest that the process held, in MB.

#include <time.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bench/methods/rivals.h"
#include "libindet/io/packing_file.h"
#include "libindet/range/analyze.h"
#include "libindet/range/extremal_search.h"
#include "libindet/range/paper_start.h"

namespace indet::bench {
namespace {

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// The largest memory that this program has held, in MB (Linux).
double peak_memory() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("VmHWM:")) return std::stod(line.substr(6)) / 1024;
  }
  return std::nan("");
}

struct Job {
  const Packing& packing;
  const ForcePolytope& polytope;
  LpOptions lp;
};

/// Our search with everything that it certifies, in the order of natural_objectives.
Tally our_search(const Job& job, SearchOptions options, bool auto_formulation = false) {
  Tally tally;
  options.lp = job.lp;
  PaperWork paper;
  for (const PolytopeBlock& block : job.polytope.blocks) {
    std::vector<Component> components;
    const std::vector<Objective> objectives = natural_objectives(job.polytope, block);
    for (std::size_t i = 1; i < objectives.size(); i += 2)
      components.push_back({objectives[i].on_edges, true, true});
    Eigen::VectorXd weight(static_cast<Eigen::Index>(block.edges.size()));
    for (std::size_t k = 0; k < block.edges.size(); ++k) {
      weight[static_cast<Eigen::Index>(k)] =
          job.polytope.problem.edges[static_cast<std::size_t>(block.edges[k])].R;
    }
    if (auto_formulation) options.formulation = choose_formulation(block.view.dim());
    const Basis start =
        options.method == Method::kPivotingPaper
            ? first_extremal_point(job.packing.simulated_forces(), job.polytope, block, job.lp, paper)
            : block.lightest;
    const SearchResult found = search_extrema(block.view, components, weight, start, options);
    tally.solves += found.solves;
    tally.pivots += found.pivots;
    tally.failures += found.paper.failures();
    const auto value = [](const Extremum& extremum) {
      return extremum.status == Extremum::Status::kOptimal ? extremum.value : std::nan("");
    };
    for (std::size_t c = 0; c < components.size(); ++c) {
      tally.optima.push_back(-value(found.minimum[c]));
      tally.optima.push_back(value(found.maximum[c]));
    }
  }
  return tally;
}

struct NamedMethod {
  std::string name;
  std::function<std::optional<Tally>(const Job&)> run;
};

SearchOptions search_by(Method method, bool canonical = false) {
  SearchOptions options;
  options.method = method;
  options.canonical_states = canonical;
  return options;
}

std::vector<NamedMethod> all_methods() {
  std::vector<NamedMethod> methods;
  for (const bool canonical : {false, true}) {
    const std::string suffix = canonical ? ", canonical states" : "";
    methods.push_back({"lp" + suffix, [=](const Job& job) {
                         return our_search(job, search_by(Method::kLp, canonical), true);
                       }});
    methods.push_back({"pivoting-tableau" + suffix, [=](const Job& job) {
                         return our_search(job, search_by(Method::kPivotingTableau, canonical));
                       }});
  }
  methods.push_back(
      {"pivoting-paper", [](const Job& job) { return our_search(job, search_by(Method::kPivotingPaper)); }});
  for (const PivotRule rule : {PivotRule::kDantzig, PivotRule::kBestNeighbour}) {
    methods.push_back({std::string("pivoting-tableau, ") + to_string(rule), [=](const Job& job) {
                         SearchOptions options = search_by(Method::kPivotingTableau);
                         options.pivot_rule = rule;
                         return our_search(job, options);
                       }});
  }
  for (const Formulation formulation : {Formulation::kNullSpace, Formulation::kDual, Formulation::kEdge}) {
    const std::string name = to_string(formulation);
    methods.push_back({"lp, " + name, [=](const Job& job) {
                         SearchOptions options = search_by(Method::kLp);
                         options.formulation = formulation;
                         return our_search(job, options);
                       }});
    methods.push_back({"GLPK " + name + ", natural order", [=](const Job& job) {
                         return plain_glpk(job.polytope, formulation, Start::kLastOptimum, false, job.lp);
                       }});
  }
  const auto glpk = [&](const std::string& name, Start start, bool by_chance) {
    methods.push_back({"GLPK edge, " + name, [=](const Job& job) {
                         return plain_glpk(job.polytope, Formulation::kEdge, start, by_chance, job.lp);
                       }});
  };
  glpk("random order", Start::kLastOptimum, true);
  glpk("from the first vertex", Start::kFirstVertex, false);
  glpk("from scratch", Start::kScratch, false);
  methods.push_back({"Clp, natural order", [](const Job& job) { return natural_order_clp(job.polytope); }});
  return methods;
}

int measure(const NamedMethod& method, const std::string& file, const LpOptions& lp) {
  const Packing packing = read_packing(file);
  const double begin = cpu_seconds();
  const ForcePolytope polytope = find_force_polytope(packing);
  const double middle = cpu_seconds();
  nlohmann::json result = {{"method", method.name},
                           {"file", file},
                           {"disks", packing.disk_count()},
                           {"contacts", packing.contact_count()},
                           {"dim", polytope.dim}};
  if (polytope.status != PolytopeStatus::kBounded) {
    std::cerr << file << ": the forces are " << to_string(polytope.status) << '\n';
    return 3;
  }
  const std::optional<Tally> tally = method.run({packing, polytope, lp});
  const double end = cpu_seconds();
  if (!tally) {
    std::cerr << method.name << ": built without it\n";
    return 4;
  }
  result["polytope_seconds"] = middle - begin;
  result["seconds"] = end - middle;
  result["solves"] = tally->solves;
  result["pivots"] = tally->pivots;
  result["failures"] = tally->failures;
  result["memory"] = peak_memory();
  result["optima"] = tally->optima;
  result["raw"] = tally->raw;
  std::cout << result.dump() << '\n';
  return 0;
}

int run(const std::vector<std::string>& arguments) {
  const std::vector<NamedMethod> methods = all_methods();
  if (arguments.size() == 1 && arguments[0] == "--list") {
    for (const NamedMethod& method : methods) std::cout << method.name << '\n';
    return 0;
  }
  if (arguments.size() < 2 || arguments.size() > 3) return 2;
  const auto method = std::find_if(methods.begin(), methods.end(),
                                   [&](const NamedMethod& known) { return known.name == arguments[0]; });
  if (method == methods.end()) return 2;
  LpOptions lp;
  if (arguments.size() == 3) lp.feasibility = lp.optimality = std::stod(arguments[2]);
  return measure(*method, arguments[1], lp);
}

}  // namespace
}  // namespace indet::bench

int main(int argc, char** argv) {
  try {
    const int status = indet::bench::run({argv + 1, argv + argc});
    if (status == 2) std::cerr << "bench_methods --list | METHOD P.h5 [TOLERANCE]\n";
    return status;
  } catch (const std::exception& error) {
    std::cerr << "bench_methods: " << error.what() << '\n';
    return 1;
  }
}
