#include "libindet/range/extrema.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "libindet/base/constants.h"
#include "libindet/base/error.h"
#include "libindet/base/tolerances.h"
#include "libindet/lp/purification.h"
#include "libindet/polytope/interior.h"
#include "libindet/polytope/recession_cone.h"
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
  ExtremaFinder(const Packing& packing, const ForcePolytope& polytope, const std::vector<int>& contacts,
                const StateChoice& kept, const SearchOptions& options)
      : simulated_(packing.simulated_forces()),
        check_(packing),
        polytope_(polytope),
        contacts_(contacts),
        kept_(kept),
        options_(options),
        states_(polytope),
        solver_states_(polytope) {
    options_.canonical_states = kept.keeps_all() && kept.kind == StateChoice::Kind::kCanonical;
    options_.solver_states = options.solver_states && options_.canonical_states;
    const auto count = static_cast<Eigen::Index>(polytope.problem.contacts.size());
    extrema_.claim.setConstant(count, 4, Outcome::kNotRequested);
    extrema_.vertex.setConstant(count, 4, -1);
    extrema_.unique.setZero(count, 4);
    extrema_.clear(count);
    extrema_.state_kind = kept.kind;
    extrema_.states_of = kept.contacts;
    if (options_.solver_states) {
      extrema_.solver_states.emplace();
      extrema_.solver_states->states.resize(0, 2 * count);
      extrema_.solver_states->vertex.setConstant(count, 4, -1);
    }
    extrema_.ray.setConstant(count, 4, -1);
    for (auto* table : {&extrema_.dual_residual, &extrema_.ray_residual})
      table->setConstant(count, 4, std::numeric_limits<double>::quiet_NaN());
    extrema_.states.resize(0, 2 * count);
    extrema_.active.resize(0, std::max(0, polytope.dim));
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
    if (kept_.kind != StateChoice::Kind::kNone && !kept_.keeps_all()) keep_some(wanted);
    if (options_.progress && !options_.progress(settled_, total_)) throw Interrupted();
    extrema_.states = states_.states();
    extrema_.active = states_.active();
    extrema_.rays = states_.rays();
    note_states(extrema_.states, extrema_.vertex, check_, extrema_);
    if (extrema_.solver_states) extrema_.solver_states->states = solver_states_.states();
    return std::move(extrema_);
  }

 private:
  /// The options of one search for so many objectives, whose progress is that of the whole: `settled_`
  /// objectives are behind it.
  SearchOptions options_for(std::int64_t objectives) const {
    SearchOptions options = options_;
    if (options_.progress) {
      options.progress = [this, objectives](std::int64_t done, std::int64_t total) {
        const std::int64_t share = total > 0 ? objectives * done / total : 0;
        return options_.progress(settled_ + share, total_);
      };
    }
    return options;
  }

  /// Switches off what is unbounded: whatever grows along some direction of the block's recession cone.
  void exclude_unbounded(std::size_t number, const Eigen::VectorXd& weight, BlockComponents& block) {
    const PolytopeBlock& whole = polytope_.blocks[number];
    const RecessionCone& recession = *whole.recession;
    const SlopeView& cone = recession.truncated;
    SearchOptions options = options_;
    options.formulation = choose_formulation_of_one(cone);
    options.canonical_states = options.solver_states = false;
    options.sink = {};
    if (options.method == Method::kPivotingPaper) options.method = Method::kLp;  // the paper met no such case
    if (options_.progress) {  // these searches may be stopped too, but settle no range yet
      options.progress = [this](std::int64_t, std::int64_t) { return options_.progress(settled_, total_); };
    }
    std::vector<Component> components;
    for (const Component& component : block.components) {
      Component& on_cone = components.emplace_back(component);
      on_cone.on_edges = recession.restricted(component.on_edges);
      const auto has_sign = [&](double sign) {
        return std::any_of(on_cone.on_edges.begin(), on_cone.on_edges.end(),
                           [&](const auto& entry) { return sign * entry.second > 0; });
      };
      on_cone.minimise = on_cone.minimise && has_sign(-1);
      on_cone.maximise = on_cone.maximise && has_sign(1);
    }
    const Basis apex =
        purify_to_vertex(cone, Eigen::VectorXd::Zero(cone.dim()), Eigen::VectorXd::Zero(cone.dim()));
    Eigen::VectorXd cone_weight(cone.inequalities());
    cone_weight << weight(recession.edges), 1;
    const SearchResult growth = search_extrema(cone, components, cone_weight, apex, options);
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
        extrema_.ray(row, column) = states_.add_ray(number, recession.ray(end.x, whole.view.inequalities()));
        extrema_.ray_residual(row, column) = end.infeasibility();
        extrema_.dual_residual(row, column) = extremum.dual_residual;
      };
      mark(block.components[c].minimise, growth.minimum[c], is_tangential ? kMinT : kMinR);
      mark(block.components[c].maximise, growth.maximum[c], is_tangential ? kMaxT : kMaxR);
    }
  }

  Eigen::VectorXd weight_of(const PolytopeBlock& block) const {
    Eigen::VectorXd weight(static_cast<Eigen::Index>(block.edges.size()));
    for (std::size_t k = 0; k < block.edges.size(); ++k) {
      weight[static_cast<Eigen::Index>(k)] =
          polytope_.problem.edges[static_cast<std::size_t>(block.edges[k])].R;
    }
    return weight;
  }

  /// Notes the values of objectives at a vertex of a block, which is then let go.
  void note_vertex(std::size_t number, const BlockComponents& block, const Vertex& vertex,
                   std::span<const std::int64_t> objectives) {
    const SceneForces forces = polytope_.problem.units.scene(state_at(polytope_, number, vertex));
    const StateResidual residual = check_(forces);
    for (const std::int64_t objective : objectives) {
      const auto [contact, is_tangential] = block.names[static_cast<std::size_t>(objective / 2)];
      extrema_.note(contact.value(), (is_tangential ? kMinT : kMinR) + static_cast<int>(objective % 2),
                    forces, residual);
    }
  }

  void search_block(std::size_t number, BlockComponents& wanted) {
    const PolytopeBlock& block = polytope_.blocks[number];
    const Eigen::VectorXd weight = weight_of(block);
    if (block.recession) exclude_unbounded(number, weight, wanted);
    const Basis start = options_.method == Method::kPivotingPaper
                            ? first_extremal_point(simulated_, polytope_, block, options_.lp, extrema_.paper)
                            : block.lightest;
    SearchOptions within = options_for(wanted.objectives());
    if (!kept_.keeps_all()) {
      within.sink = [&](const Vertex& vertex, std::span<const std::int64_t> objectives) {
        note_vertex(number, wanted, vertex, objectives);
      };
    }
    SearchResult found = search_extrema(block.view, wanted.components, weight, start, within);
    extrema_.paper += found.paper;
    extrema_.state_seconds += found.state_seconds;
    extrema_.solves += found.solves;
    extrema_.pivots += found.pivots;
    for (std::size_t c = 0; c < wanted.components.size(); ++c) {
      const auto [contact, is_tangential] = wanted.names[c];
      const auto store = [&, row = contact.value()](bool asked, Extremum& extremum, int column) {
        if (!asked) return;
        const bool optimal = extremum.status == Extremum::Status::kOptimal;
        extrema_.claim(row, column) = optimal ? Outcome::kOptimal : Outcome::kFailed;
        if (!optimal) return;
        if (kept_.keeps_all()) {
          const Vertex& vertex = found.vertices[static_cast<std::size_t>(extremum.vertex)];
          extrema_.vertex(row, column) = states_.add(number, vertex);
        }
        if (extrema_.solver_states) {
          const Vertex& landed = found.vertices[static_cast<std::size_t>(extremum.solver_vertex)];
          extrema_.solver_states->vertex(row, column) = solver_states_.add(number, landed);
        }
        extrema_.proofs.push_back({row, column, number, std::move(extremum.proof)});
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
    std::optional<SceneForces> lightest;
    StateResidual residual;
    for (const int i : contacts_) {
      for (int column = 0; column < 4; ++column) {
        if (extrema_.claim(i, column) != Outcome::kNotRequested) continue;
        extrema_.claim(i, column) = Outcome::kOptimal;
        if (kept_.keeps_all()) {
          extrema_.vertex(i, column) = states_.lightest();
        } else {
          if (!lightest) {
            lightest = polytope_.problem.units.scene(polytope_.problem.state(polytope_.lightest));
            residual = check_(*lightest);
          }
          extrema_.note(i, column, *lightest, residual);
        }
        if (extrema_.solver_states) extrema_.solver_states->vertex(i, column) = solver_states_.lightest();
        extrema_.dual_residual(i, column) = 0;
        extrema_.unique(i, column) = polytope_.dim == 0 ? 1 : 0;
        ++extrema_.determined;
      }
    }
  }

  /// Finds the states again of the contacts of which they are kept.
  void keep_some(const std::vector<BlockComponents>& searched) {
    const auto begin = std::chrono::steady_clock::now();
    Table4<double> value = extrema_.value;
    for (const int column : {kMinR, kMaxR, kMinT, kMaxT}) {
      const double infinite = column == kMaxR || column == kMaxT ? kInfinity : -kInfinity;
      value.col(column) = (extrema_.ray.col(column) >= 0).select(infinite, value.col(column));
    }
    const std::vector<int> chosen = contacts_with_states(kept_, value);
    extrema_.state_contacts = Eigen::Map<const Eigen::ArrayXi>(chosen.data(), std::ssize(chosen));
    std::vector<std::vector<OptimalBasis*>> proofs(searched.size());
    for (OptimalBasis& proof : extrema_.proofs) {
      if (std::binary_search(chosen.begin(), chosen.end(), static_cast<int>(proof.contact)))
        proofs[proof.block].push_back(&proof);
    }
    for (std::size_t number = 0; number < searched.size(); ++number) {
      const SlopeView& view = polytope_.blocks[number].view;
      for (const OptimalBasis* proof : proofs[number])
        extrema_.vertex(proof->contact, proof->column) = kNotYet;
      if (kept_.kind == StateChoice::Kind::kCanonical)
        make_canonical(number, searched[number], proofs[number]);
      for (const OptimalBasis* proof : proofs[number]) {
        std::int32_t& row = extrema_.vertex(proof->contact, proof->column);
        if (row == kNotYet) row = states_.add(number, locate_vertex(view, proof->basis));
      }
    }
    for (const int i : chosen) {
      for (int column = 0; column < 4; ++column) {
        const bool is_determined =
            extrema_.claim(i, column) == Outcome::kOptimal && extrema_.vertex(i, column) < 0;
        if (is_determined) extrema_.vertex(i, column) = states_.lightest();
      }
    }
    extrema_.state_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }

  /// Stores the canonical states of objectives of one block whose optimal face is known.
  void make_canonical(std::size_t number, const BlockComponents& searched,
                      const std::vector<OptimalBasis*>& proofs) {
    const PolytopeBlock& block = polytope_.blocks[number];
    std::map<std::pair<Eigen::Index, int>, OptimalBasis*> known;
    std::vector<Basis> bases;
    for (OptimalBasis* proof : proofs) {
      if (extrema_.dual_residual(proof->contact, proof->column) > tolerance::kReducedCost) continue;
      known[{proof->contact, proof->column}] = proof;
      bases.push_back(proof->basis);
    }
    BlockComponents wanted;
    for (std::size_t c = 0; c < searched.components.size(); ++c) {
      const auto [contact, is_tangential] = searched.names[c];
      Component component = searched.components[c];
      component.minimise = known.contains({contact.value(), is_tangential ? kMinT : kMinR});
      component.maximise = known.contains({contact.value(), is_tangential ? kMaxT : kMaxR});
      if (!component.minimise && !component.maximise) continue;
      wanted.components.push_back(std::move(component));
      wanted.names.push_back(searched.names[c]);
    }
    SearchOptions options = options_;
    options.canonical_states = true;
    if (options.method == Method::kPivotingPaper) options.method = Method::kLp;
    if (options_.progress)
      options.progress = [this](std::int64_t, std::int64_t) { return options_.progress(settled_, total_); };
    const SearchResult found =
        search_extrema(block.view, wanted.components, weight_of(block), block.lightest, options, bases);
    extrema_.solves += found.solves;
    extrema_.pivots += found.pivots;
    for (std::size_t c = 0; c < wanted.components.size(); ++c) {
      const auto [contact, is_tangential] = wanted.names[c];
      const auto store = [&, row = contact.value()](bool asked, const Extremum& extremum, int column) {
        if (!asked || extremum.status != Extremum::Status::kOptimal) return;
        known.at({row, column})->basis = extremum.proof;
        extrema_.vertex(row, column) =
            states_.add(number, found.vertices[static_cast<std::size_t>(extremum.vertex)]);
        extrema_.dual_residual(row, column) = extremum.dual_residual;
        extrema_.unique(row, column) = extremum.unique && polytope_.blocks.size() == 1 ? 1 : 0;
      };
      store(wanted.components[c].minimise, found.minimum[c], is_tangential ? kMinT : kMinR);
      store(wanted.components[c].maximise, found.maximum[c], is_tangential ? kMaxT : kMaxR);
    }
  }

  /// Of an objective whose state is about to be stored.
  static constexpr std::int32_t kNotYet = -2;

  SceneForces simulated_;
  StateChecker check_;
  const ForcePolytope& polytope_;
  const std::vector<int>& contacts_;
  const StateChoice& kept_;
  SearchOptions options_;
  StateTable states_;
  StateTable solver_states_;
  std::int64_t settled_ = 0;  ///< objectives that are determined, unbounded, or of a block that is done
  std::int64_t total_ = 0;
  Extrema extrema_;
};

}  // namespace

Extrema find_extrema(const Packing& packing, const ForcePolytope& polytope, const std::vector<int>& contacts,
                     const StateChoice& kept, const SearchOptions& options) {
  return ExtremaFinder(packing, polytope, contacts, kept, options).run();
}

}  // namespace indet
