#include "libindet/range/extrema.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "libindet/base/error.h"
#include "libindet/base/tolerances.h"
#include "libindet/lp/purification.h"
#include "libindet/polytope/interior.h"
#include "libindet/range/paper_start.h"
#include "libindet/range/state_table.h"

namespace indet {
namespace {

/// The components of the contact forces that live in one block.
struct BlockComponents {
  std::vector<Component> components;
  std::vector<std::pair<ContactId, bool>> names;  ///< contact; true: tangential

  std::int64_t objectives() const {
    std::int64_t count = 0;
    for (const Component& component : components)
      count += (component.minimise ? 1 : 0) + (component.maximise ? 1 : 0);
    return count;
  }
};

BlockComponents components_of(const ForcePolytope& polytope, const PolytopeBlock& block,
                              const std::vector<int>& contacts) {
  std::map<int, std::pair<Component, Component>> by_contact;
  for (std::size_t k = 0; k < block.edges.size(); ++k) {
    const Edge& edge = polytope.problem.edges[static_cast<std::size_t>(block.edges[k])];
    if (edge.is_slack()) continue;
    auto& [normal, tangential] = by_contact[edge.contact.value()];
    normal.on_edges.emplace_back(static_cast<int>(k), edge.R);
    if (edge.T != 0) tangential.on_edges.emplace_back(static_cast<int>(k), edge.T);
  }
  BlockComponents result;
  for (auto& [contact, pair] : by_contact) {
    if (!std::binary_search(contacts.begin(), contacts.end(), contact)) continue;
    for (const bool is_tangential : {false, true}) {
      Component& component = is_tangential ? pair.second : pair.first;
      // A component may be determined although the other one of its contact is not.
      const Objective objective = make_objective(block.view, component.on_edges);
      if (objective.along_z.norm() <= tolerance::kConstantComponent) continue;
      result.components.push_back(std::move(component));
      result.names.emplace_back(ContactId(contact), is_tangential);
    }
  }
  return result;
}

/// Finds the extrema of one block after the other.
class ExtremaFinder {
 public:
  ExtremaFinder(const ForcePolytope& polytope, const std::vector<int>& contacts, const SceneForces& simulated,
                const SearchOptions& options)
      : simulated_(simulated),
        polytope_(polytope),
        contacts_(contacts),
        options_(options),
        states_(polytope),
        solver_states_(polytope) {
    const auto count = static_cast<Eigen::Index>(polytope.problem.contacts.size());
    extrema_.claim.setConstant(count, 4, Outcome::kNotRequested);
    extrema_.vertex.setConstant(count, 4, -1);
    extrema_.unique.setZero(count, 4);
    if (options.solver_states) {
      extrema_.solver_states.emplace();
      extrema_.solver_states->states.resize(0, 2 * count);
      extrema_.solver_states->vertex.setConstant(count, 4, -1);
    }
    extrema_.ray.setConstant(count, 4, -1);
    for (auto* table : {&extrema_.dual_residual, &extrema_.ray_residual})
      table->setConstant(count, 4, std::numeric_limits<double>::quiet_NaN());
    extrema_.states.resize(0, 2 * count);
    extrema_.rays.resize(0, 2 * count);
    extrema_.method = options.method;
    extrema_.paper_options = options.paper;
    if (options.method != Method::kPivotingTableau) extrema_.formulation = to_string(options.formulation);
    extrema_.solves = polytope.solves;
    extrema_.pivots = polytope.pivots;
  }

  Extrema run() {
    if (polytope_.status == PolytopeStatus::kEmpty) return std::move(extrema_);
    std::vector<BlockComponents> wanted;
    total_ = settled_ = 4 * static_cast<std::int64_t>(contacts_.size());
    for (const PolytopeBlock& block : polytope_.blocks) {
      wanted.push_back(components_of(polytope_, block, contacts_));
      settled_ -= wanted.back().objectives();
    }
    for (std::size_t number = 0; number < wanted.size(); ++number) search_block(number, wanted[number]);
    store_determined();
    if (options_.progress && !options_.progress(settled_, total_)) throw Interrupted();
    extrema_.states = states_.states();
    extrema_.active = states_.active();
    extrema_.rays = states_.rays();
    if (extrema_.solver_states) extrema_.solver_states->states = solver_states_.states();
    return std::move(extrema_);
  }

 private:
  /// The options of one search, whose progress is that of the whole: `settled_` objectives are behind it.
  SearchOptions options_within() const {
    SearchOptions options = options_;
    if (options_.progress) {
      options.progress = [this](std::int64_t settled, std::int64_t) {
        return options_.progress(settled_ + settled, total_);
      };
    }
    return options;
  }

  /// Switches off what is unbounded: whatever grows along some direction of the block's recession cone.
  void exclude_unbounded(std::size_t number, const Eigen::VectorXd& weight, BlockComponents& block) {
    const SlopeView& view = polytope_.blocks[number].view;
    const SlopeView cone = truncated_recession_cone(view);
    SearchOptions options = options_;
    options.formulation = Formulation::kDual;
    options.canonical_states = options.solver_states = false;
    if (options.method == Method::kPivotingPaper) options.method = Method::kLp;  // the paper met no such case
    if (options_.progress) {  // these searches may be stopped too, but settle no range yet
      options.progress = [this](std::int64_t, std::int64_t) { return options_.progress(settled_, total_); };
    }
    const Basis apex =
        purify_to_vertex(cone, Eigen::VectorXd::Zero(cone.dim()), Eigen::VectorXd::Zero(cone.dim()));
    Eigen::VectorXd cone_weight(weight.size() + 1);
    cone_weight << weight, 1;
    const SearchResult growth = search_extrema(cone, block.components, cone_weight, apex, options);
    extrema_.solves += growth.solves;
    extrema_.pivots += growth.pivots;
    for (std::size_t c = 0; c < block.components.size(); ++c) {
      const auto [contact, is_tangential] = block.names[c];
      const auto mark = [&, row = contact.value()](bool& wanted, const Extremum& extremum, int column) {
        const bool grows =
            extremum.status == Extremum::Status::kOptimal && std::abs(extremum.value) > tolerance::kRay;
        if (!grows) return;
        wanted = false;
        ++settled_;
        const Vertex& end = growth.vertices[static_cast<std::size_t>(extremum.vertex)];
        const bool is_ray = end.infeasibility() <= tolerance::kRayResidual;
        extrema_.claim(row, column) = is_ray ? Outcome::kUnbounded : Outcome::kImprecise;
        extrema_.ray(row, column) = states_.add_ray(number, end.x.head(view.inequalities()));
        extrema_.ray_residual(row, column) = end.infeasibility();
        extrema_.dual_residual(row, column) = extremum.dual_residual;
      };
      mark(block.components[c].minimise, growth.minimum[c], is_tangential ? kMinT : kMinR);
      mark(block.components[c].maximise, growth.maximum[c], is_tangential ? kMaxT : kMaxR);
    }
  }

  void search_block(std::size_t number, BlockComponents& wanted) {
    const PolytopeBlock& block = polytope_.blocks[number];
    Eigen::VectorXd weight(static_cast<Eigen::Index>(block.edges.size()));
    for (std::size_t k = 0; k < block.edges.size(); ++k) {
      weight[static_cast<Eigen::Index>(k)] =
          polytope_.problem.edges[static_cast<std::size_t>(block.edges[k])].R;
    }
    if (block.unbounded) exclude_unbounded(number, weight, wanted);
    const Basis start = options_.method == Method::kPivotingPaper
                            ? first_extremal_point(simulated_, polytope_, block, options_.lp, extrema_.paper)
                            : block.lightest;
    const SearchResult found = search_extrema(block.view, wanted.components, weight, start, options_within());
    extrema_.paper += found.paper;
    extrema_.state_seconds += found.state_seconds;
    extrema_.solves += found.solves;
    extrema_.pivots += found.pivots;
    for (std::size_t c = 0; c < wanted.components.size(); ++c) {
      const auto [contact, is_tangential] = wanted.names[c];
      const auto store = [&, row = contact.value()](bool asked, const Extremum& extremum, int column) {
        if (!asked) return;
        const bool optimal = extremum.status == Extremum::Status::kOptimal;
        extrema_.claim(row, column) = optimal ? Outcome::kOptimal : Outcome::kFailed;
        if (!optimal) return;
        const Vertex& vertex = found.vertices[static_cast<std::size_t>(extremum.vertex)];
        extrema_.vertex(row, column) = states_.add(number, vertex);
        if (extrema_.solver_states) {
          const Vertex& landed = found.vertices[static_cast<std::size_t>(extremum.solver_vertex)];
          extrema_.solver_states->vertex(row, column) = solver_states_.add(number, landed);
        }
        extrema_.proofs.push_back({row, column, number, extremum.proof});
        extrema_.dual_residual(row, column) = extremum.dual_residual;
        extrema_.unique(row, column) = extremum.unique && polytope_.blocks.size() == 1 ? 1 : 0;
      };
      store(wanted.components[c].minimise, found.minimum[c], is_tangential ? kMinT : kMinR);
      store(wanted.components[c].maximise, found.maximum[c], is_tangential ? kMaxT : kMaxR);
    }
    settled_ += wanted.objectives();
  }

  /// Objectives that no linear program was needed for: their value is the same everywhere in F.
  void store_determined() {
    for (const int i : contacts_) {
      for (int column = 0; column < 4; ++column) {
        if (extrema_.claim(i, column) != Outcome::kNotRequested) continue;
        extrema_.claim(i, column) = Outcome::kOptimal;
        extrema_.vertex(i, column) = states_.lightest();
        if (extrema_.solver_states) extrema_.solver_states->vertex(i, column) = solver_states_.lightest();
        extrema_.dual_residual(i, column) = 0;
        extrema_.unique(i, column) = polytope_.dim == 0 ? 1 : 0;
        ++extrema_.determined;
      }
    }
  }

  const SceneForces& simulated_;
  const ForcePolytope& polytope_;
  const std::vector<int>& contacts_;
  const SearchOptions& options_;
  StateTable states_;
  StateTable solver_states_;
  std::int64_t settled_ = 0;  ///< objectives that are determined, unbounded, or of a block that is done
  std::int64_t total_ = 0;
  Extrema extrema_;
};

}  // namespace

Extrema find_extrema(const ForcePolytope& polytope, const std::vector<int>& contacts,
                     const SceneForces& simulated, const SearchOptions& options) {
  return ExtremaFinder(polytope, contacts, simulated, options).run();
}

}  // namespace indet
