#include "libindet/range/analyze.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "libindet/base/error.h"
#include "libindet/base/tolerances.h"
#include "libindet/exact/certificate.h"
#include "libindet/lp/purification.h"
#include "libindet/polytope/force_polytope.h"
#include "libindet/polytope/interior.h"
#include "libindet/range/certify.h"
#include "libindet/range/enclosure.h"
#include "libindet/range/extremal_search.h"
#include "libindet/range/measures.h"
#include "libindet/range/paper_start.h"
#include "libindet/range/state_table.h"

namespace indet {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Adds the time since the last mark to a stage.
class Stopwatch {
 public:
  explicit Stopwatch(std::map<std::string, double>& seconds) : seconds_(seconds) {}
  void mark(const std::string& stage) {
    const auto now = std::chrono::steady_clock::now();
    seconds_[stage] += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }

 private:
  std::map<std::string, double>& seconds_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

void size_tables(const Packing& packing, ForceRanges& ranges) {
  const Eigen::Index count = packing.contact_count();
  for (auto* table : {&ranges.value, &ranges.lower, &ranges.upper, &ranges.sensitivity,
                      &ranges.primal_residual, &ranges.dual_residual}) {
    table->setConstant(count, 4, ForceRanges::kNaN);
  }
  ranges.outcome.setConstant(count, 4, Outcome::kNotRequested);
  ranges.unique.setZero(count, 4);
  ranges.vertex.setConstant(count, 4, -1);
  ranges.ray.setConstant(count, 4, -1);
  ranges.rays.resize(0, 2 * count);
  ranges.states.resize(0, 2 * count);
  ranges.active.resize(0, 0);
}

/// The components of the contact forces that live in one block.
struct BlockComponents {
  std::vector<Component> components;
  std::vector<std::pair<ContactId, bool>> names;  ///< contact; true: tangential
};

BlockComponents components_of(const ForcePolytope& polytope, const PolytopeBlock& block,
                              const std::vector<int>& requested) {
  std::map<int, std::pair<Component, Component>> by_contact;
  for (std::size_t k = 0; k < block.edges.size(); ++k) {
    const Edge& edge = polytope.problem.edges[static_cast<std::size_t>(block.edges[k])];
    auto& [normal, tangential] = by_contact[edge.contact.value()];
    normal.on_edges.emplace_back(static_cast<int>(k), edge.R);
    if (edge.T != 0) tangential.on_edges.emplace_back(static_cast<int>(k), edge.T);
  }
  BlockComponents result;
  for (auto& [contact, pair] : by_contact) {
    if (!std::binary_search(requested.begin(), requested.end(), contact)) continue;
    for (const bool is_tangential : {false, true}) {
      Component& component = is_tangential ? pair.second : pair.first;
      // A component may be determined although the other one of its contact is not.
      const Objective objective = make_objective(block.set, component.on_edges);
      if (objective.along_z.norm() <= tolerance::kReducedCost) continue;
      result.components.push_back(std::move(component));
      result.names.emplace_back(ContactId(contact), is_tangential);
    }
  }
  return result;
}

/// Switches off what is unbounded: whatever grows along some direction of the block's recession cone.
void exclude_unbounded(const FeasibleSet& set, const SearchOptions& options, const Eigen::VectorXd& weight,
                       BlockComponents& block, StateTable& states, std::size_t number, ForceRanges& ranges) {
  const FeasibleSet cone = truncated_recession_cone(set);
  SearchOptions cone_options = options;
  cone_options.formulation = Formulation::kDual;
  cone_options.canonical_states = false;
  if (options.method == Method::kPivotingPaper)
    cone_options.method = Method::kLp;  // the paper met no such case
  if (options.progress) {               // these searches may be stopped too, but settle no range yet
    cone_options.progress = [&](std::int64_t, std::int64_t total) { return options.progress(0, total); };
  }
  const Basis apex =
      purify_to_vertex(cone, Eigen::VectorXd::Zero(cone.dim()), Eigen::VectorXd::Zero(cone.dim()));
  Eigen::VectorXd cone_weight(weight.size() + 1);
  cone_weight << weight, 1;
  const SearchResult growth = search_extrema(cone, block.components, cone_weight, apex, cone_options);
  ranges.solves += growth.solves;
  ranges.pivots += growth.pivots;
  for (std::size_t c = 0; c < block.components.size(); ++c) {
    const ContactId contact = block.names[c].first;
    const bool is_tangential = block.names[c].second;
    const auto mark = [&](bool& wanted, const Extremum& extremum, int column, double infinite) {
      const bool grows =
          extremum.status == Extremum::Status::kOptimal && std::abs(extremum.value) > tolerance::kRay;
      if (!grows) return;
      wanted = false;
      ranges.value(contact.value(), column) = infinite;
      const Vertex& end = growth.vertices[static_cast<std::size_t>(extremum.vertex)];
      const bool is_ray = end.infeasibility() <= tolerance::kPrimalResidual;
      ranges.outcome(contact.value(), column) = is_ray ? Outcome::kUnbounded : Outcome::kImprecise;
      ranges.ray(contact.value(), column) = states.add_ray(number, end.x.head(set.inequalities()));
      ranges.primal_residual(contact.value(), column) = end.infeasibility();
      ranges.dual_residual(contact.value(), column) = extremum.dual_residual;
    };
    mark(block.components[c].minimise, growth.minimum[c], is_tangential ? kMinT : kMinR, -kInfinity);
    mark(block.components[c].maximise, growth.maximum[c], is_tangential ? kMaxT : kMaxR, kInfinity);
  }
}

void search_block(const Packing& packing, const ForcePolytope& polytope, std::size_t number,
                  const std::vector<int>& requested, const SearchOptions& options, StateTable& states,
                  std::vector<OptimalBasis>& optima, ForceRanges& ranges) {
  const PolytopeBlock& block = polytope.blocks[number];
  Eigen::VectorXd weight(static_cast<Eigen::Index>(block.edges.size()));
  for (std::size_t k = 0; k < block.edges.size(); ++k) {
    weight[static_cast<Eigen::Index>(k)] = polytope.problem.edges[static_cast<std::size_t>(block.edges[k])].R;
  }
  BlockComponents wanted = components_of(polytope, block, requested);
  if (block.unbounded) exclude_unbounded(block.set, options, weight, wanted, states, number, ranges);
  const Basis start =
      options.method == Method::kPivotingPaper
          ? first_extremal_point(packing.simulated_forces(), polytope, block, options.lp, ranges.paper)
          : block.lightest;
  const SearchResult found = search_extrema(block.set, wanted.components, weight, start, options);
  ranges.paper += found.paper;
  ranges.seconds["states"] += found.state_seconds;
  ranges.solves += found.solves;
  ranges.pivots += found.pivots;
  for (std::size_t c = 0; c < wanted.components.size(); ++c) {
    const ContactId contact = wanted.names[c].first;
    const bool is_tangential = wanted.names[c].second;
    const auto store = [&](bool asked, const Extremum& extremum, int column) {
      if (!asked) return;
      const bool optimal = extremum.status == Extremum::Status::kOptimal;
      ranges.outcome(contact.value(), column) = optimal ? Outcome::kOptimal : Outcome::kFailed;
      if (!optimal) return;
      const Vertex& vertex = found.vertices[static_cast<std::size_t>(extremum.vertex)];
      ranges.vertex(contact.value(), column) = states.add(number, vertex);
      optima.push_back({contact.value(), column, number, extremum.proof});
      ranges.dual_residual(contact.value(), column) = extremum.dual_residual;
      ranges.unique(contact.value(), column) = extremum.unique && polytope.blocks.size() == 1 ? 1 : 0;
    };
    store(wanted.components[c].minimise, found.minimum[c], is_tangential ? kMinT : kMinR);
    store(wanted.components[c].maximise, found.maximum[c], is_tangential ? kMaxT : kMaxR);
  }
}

/// Repeats each ray in rational numbers. Where one is not a ray exactly, forces that grow along it are
/// limited after all, and other values may belong to vertices that are far away.
bool proves_rays(const Packing& packing, const exact::ContactProblem& exact, const ForceRanges& ranges) {
  if (ranges.rays.rows() == 0) return true;
  for (Eigen::Index q = 0; q < ranges.rays.rows(); ++q) {
    const std::span<const double> ray(&ranges.rays(q, 0), static_cast<std::size_t>(ranges.rays.cols()));
    if (!exact::proves_ray(exact, exact::edge_strengths(packing, ray), tolerance::kReducedCost)) return false;
  }
  return true;
}

/// Objectives that no linear program was needed for: their value is the same everywhere in F.
void store_determined(const std::vector<int>& requested, StateTable& states, ForceRanges& ranges) {
  for (const int i : requested) {
    for (int column = 0; column < 4; ++column) {
      if (ranges.outcome(i, column) != Outcome::kNotRequested) continue;
      ranges.outcome(i, column) = Outcome::kOptimal;
      ranges.vertex(i, column) = states.lightest();
      ranges.dual_residual(i, column) = 0;
      ranges.unique(i, column) = ranges.dim == 0 ? 1 : 0;
      ++ranges.determined;
    }
  }
}

void describe_problem(const ForcePolytope& polytope, ForceRanges& ranges) {
  const NullSpace& null_space = *polytope.natural_null_space;
  ranges.status = polytope.status;
  ranges.unknowns = polytope.natural.unknowns();
  ranges.equations = polytope.natural.equations();
  ranges.rank = null_space.rank;
  ranges.nullity = null_space.nullity;
  ranges.dim = polytope.dim;
  ranges.blocks = static_cast<int>(polytope.blocks.size());
  ranges.rank_gap = null_space.rank_gap();
  ranges.smallest_accepted = null_space.smallest_accepted;
  ranges.largest_rejected = null_space.largest_rejected;
  ranges.rank_ambiguous = polytope.rank_ambiguous;
  ranges.doubtful = polytope.doubtful;
  ranges.motion = polytope.motion;
  ranges.solves = polytope.solves;
  ranges.pivots = polytope.pivots;
}

}  // namespace

Formulation choose_formulation(int dim) {
  constexpr int kCrossOver = 30;
  return dim <= kCrossOver ? Formulation::kDual : Formulation::kEdge;
}

AnalyzeOptions options_for(Accuracy accuracy) {
  AnalyzeOptions options;
  options.canonical_states = accuracy != Accuracy::kFast;
  return options;
}

ForceRanges analyze(const Packing& packing, const AnalyzeOptions& options) {
  ForceRanges ranges;
  Stopwatch stopwatch(ranges.seconds);
  size_tables(packing, ranges);
  const ForcePolytope polytope = find_force_polytope(packing, options.lp);
  describe_problem(polytope, ranges);
  ranges.force_unit = packing.force_unit();
  stopwatch.mark("polytope");

  SearchOptions search;
  int largest = 0;
  for (const PolytopeBlock& block : polytope.blocks) {
    largest = std::max(largest, block.set.dim());
  }
  search.formulation = options.formulation.value_or(choose_formulation(largest));
  search.method = options.method;
  search.lp = options.lp;
  search.threads = options.threads;
  search.canonical_states = options.canonical_states;
  ranges.method = options.method;
  if (options.method != Method::kPivotingTableau) ranges.formulation = to_string(search.formulation);
  const std::vector<int> requested = chosen_contacts(options.contacts, packing.contact_count());
  ranges.choice = options.contacts.kind;
  ranges.requested = static_cast<int>(requested.size());
  if (ranges.choice == ContactChoice::Kind::kSample)
    ranges.sample_seed = static_cast<std::int64_t>(options.contacts.seed);
  std::int64_t done = 0;
  if (options.progress) {
    search.progress = [&](std::int64_t settled, std::int64_t) {
      return options.progress({"force ranges", done + settled, 4 * ranges.requested, {}});
    };
  }
  if (polytope.status != PolytopeStatus::kEmpty) {
    StateTable states(polytope);
    std::vector<OptimalBasis> optima;
    for (std::size_t b = 0; b < polytope.blocks.size(); ++b) {
      search_block(packing, polytope, b, requested, search, states, optima, ranges);
      done += 2 * polytope.blocks[b].set.inequalities();
    }
    store_determined(requested, states, ranges);
    states.write(ranges);
    stopwatch.mark("ranges");
    ranges.seconds["ranges"] -= ranges.seconds["states"];
    const bool proven =
        enclose_values(polytope, optima, ranges) && proves_rays(packing, *polytope.exact, ranges);
    ranges.doubtful = ranges.doubtful || !proven;
    stopwatch.mark("enclosures");
  }
  certify(packing, ranges);
  compute_measures(packing, ranges);
  stopwatch.mark("measures");
  return ranges;
}

}  // namespace indet
