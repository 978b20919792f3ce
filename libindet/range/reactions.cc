#include "libindet/range/reactions.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "libindet/base/constants.h"
#include "libindet/base/tolerances.h"
#include "libindet/equilibrium/contact_state.h"
#include "libindet/lp/purification.h"
#include "libindet/lp/vertex.h"
#include "libindet/polytope/interior.h"
#include "libindet/polytope/recession_cone.h"

namespace indet {
namespace {

/// What one block adds to an extremum.
struct BlockAnswer {
  Outcome outcome = Outcome::kFailed;
  Vertex vertex;
  Eigen::VectorXd ray;  ///< if unbounded, on the block's edges
  double dual_residual = 0;
};

/// Maximises functionals over one block of F.
class BlockSearch {
 public:
  BlockSearch(const PolytopeBlock& block, Formulation formulation, const LpOptions& options)
      : block_(block), solver_(block.view, formulation, options) {
    if (!block.recession) return;
    const SlopeView& cone = block.recession->truncated;
    cone_solver_.emplace(cone, choose_formulation_of_one(cone), options);
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(cone.dim());
    end_ = locate_vertex(cone, purify_to_vertex(cone, zero, zero));
  }

  /// Nothing if the functional (of the block's edges) is the same everywhere in the block. `start`: a vertex.
  std::optional<BlockAnswer> maximise(const std::vector<std::pair<int, double>>& on_edges,
                                      const Basis& start) {
    const Objective objective = make_objective(block_.view, on_edges);
    double size = 0;
    for (const auto& [edge, coefficient] : on_edges) size = std::max(size, std::abs(coefficient));
    if (objective.along_z.norm() <= tolerance::kConstantComponent * size) return {};
    BlockAnswer result;
    if (cone_solver_) {
      const RecessionCone& recession = *block_.recession;
      const SlopeView& cone = recession.truncated;
      const Objective growth = make_objective(cone, recession.restricted(on_edges));
      const LpAnswer answer = cone_solver_->maximise(growth, end_.basis);
      if (answer.status != LpStatus::kOptimal) return result;
      // The solver stands there with its factors, and where it stays ours are still good.
      if (answer.basis != end_.basis) end_ = locate_vertex(cone, answer.basis);
      const Vertex& end = end_;
      double grown = 0;
      for (const auto& [edge, coefficient] : growth.on_edges) grown += coefficient * end.x[edge];
      if (grown > tolerance::kRay * size) {
        result.outcome =
            end.infeasibility() <= tolerance::kRayResidual ? Outcome::kUnbounded : Outcome::kImprecise;
        result.ray = recession.ray(end.x, block_.view.inequalities());
        return result;
      }
    }
    const LpAnswer answer = solver_.maximise(objective, start);
    if (answer.status != LpStatus::kOptimal) return result;
    result.vertex = locate_vertex(block_.view, answer.basis);
    const Eigen::VectorXd costs = result.vertex.multipliers(objective);
    result.dual_residual = costs.size() > 0 ? std::max(0.0, -costs.minCoeff()) / std::max(1.0, size) : 0;
    result.outcome = Outcome::kOptimal;
    return result;
  }

 private:
  const PolytopeBlock& block_;
  LpSolver solver_;
  std::optional<LpSolver> cone_solver_;  ///< of the recession cone
  Vertex end_;                           ///< the last one of the cone, at first its apex
};

class ReactionFinder {
 public:
  ReactionFinder(const Packing& packing, const ForcePolytope& polytope, const Extrema& extrema,
                 Formulation formulation, const LpOptions& options)
      : packing_(packing), polytope_(polytope), extrema_(extrema), sums_(reaction_sums(packing)) {
    for (const PolytopeBlock& block : polytope.blocks)
      blocks_.push_back(std::make_unique<BlockSearch>(block, formulation, options));
    const auto count = static_cast<Eigen::Index>(sums_.size());
    Reactions& r = found_.reactions;
    r.body.resize(count);
    r.component.resize(count);
    for (Eigen::Index k = 0; k < count; ++k) {
      r.body[k] = sums_[static_cast<std::size_t>(k)].body.code();
      r.component[k] = sums_[static_cast<std::size_t>(k)].component;
    }
    for (auto* table : {&r.value, &r.lower, &r.upper}) table->setConstant(count, 2, kNaN);
    r.outcome.setConstant(count, 2, Outcome::kNotRequested);
    for (auto* table : {&r.vertex, &r.ray}) table->setConstant(count, 2, -1);
    for (auto* rows : {&r.states, &r.rays})
      rows->resize(0, static_cast<Eigen::Index>(2 * packing.contact_count()));
  }

  FoundReactions run() {
    if (polytope_.status == PolytopeStatus::kEmpty) return std::move(found_);
    for (Eigen::Index k = 0; k < found_.reactions.count(); ++k) {
      for (const int end : {0, 1}) find(k, end);
    }
    return std::move(found_);
  }

 private:
  void find(Eigen::Index row, int end) {
    const double sign = end == 0 ? -1 : 1;
    const Eigen::VectorXd& coefficients = sums_[static_cast<std::size_t>(row)].coefficients;
    SumAtOptimum optimum{sign * coefficients, {}, {}};
    Reactions& r = found_.reactions;
    Outcome& outcome = r.outcome(row, end);
    outcome = Outcome::kOptimal;
    double dual_residual = 0;
    Eigen::VectorXd x = polytope_.lightest;
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      const PolytopeBlock& block = polytope_.blocks[b];
      const auto objective = on_edges(block, optimum.coefficients);
      const auto answer = blocks_[b]->maximise(objective, start_of(b, optimum.coefficients));
      if (!answer) continue;
      if (answer->ray.size() > 0) {
        Eigen::VectorXd whole = Eigen::VectorXd::Zero(x.size());
        whole(block.edges) = answer->ray;
        Eigen::VectorXd ray = polytope_.problem.state(whole).value();
        r.ray(row, end) = append(r.rays, ray / ray.lpNorm<Eigen::Infinity>());
      }
      if (answer->outcome == Outcome::kUnbounded) {
        // What grows in one block grows whatever the others do.
        outcome = Outcome::kUnbounded;
        break;
      }
      if (answer->outcome != Outcome::kOptimal) {
        if (outcome != Outcome::kFailed) outcome = answer->outcome;
        continue;
      }
      x(block.edges) = answer->vertex.x;
      optimum.bases.emplace_back(b, answer->vertex.basis);
      dual_residual = std::max(dual_residual, answer->dual_residual);
    }
    if (outcome == Outcome::kFailed) return;
    if (outcome != Outcome::kOptimal) {
      r.value(row, end) = sign * kInfinity;
      return;
    }
    optimum.state = polytope_.problem.state(x);
    const SceneForces forces = polytope_.problem.units.scene(optimum.state);
    r.value(row, end) = coefficients.dot(forces.value());
    const double unit = packing_.force_unit();
    const double scale =
        std::max(packing_.internal_force_unit(), forces.value().lpNorm<Eigen::Infinity>()) / unit;
    const double primal =
        std::max({largest_imbalance(packing_, forces), count_coulomb(packing_, forces, 0).worst_violation,
                  worst_bound_violation(bounds_, forces) / unit}) /
        scale;
    if (primal > tolerance::kPrimalResidual || dual_residual > tolerance::kDualResidual)
      outcome = Outcome::kImprecise;
    r.vertex(row, end) = append(r.states, forces.value());
    found_.optima.push_back(std::move(optimum));
    found_.entries.push_back(static_cast<std::int32_t>(2 * row + end));
  }

  /// Adds a row, and returns its number.
  static std::int32_t append(Rows<double>& rows, const Eigen::VectorXd& row) {
    rows.conservativeResize(rows.rows() + 1, Eigen::NoChange);
    rows.bottomRows(1) = row.transpose();
    return static_cast<std::int32_t>(rows.rows() - 1);
  }

  /// The basis of that extremal state of a contact in the block at which what the block adds is largest.
  Basis start_of(std::size_t block, const Eigen::VectorXd& coefficients) const {
    std::vector<Eigen::Index> summed;
    for (const int k : polytope_.blocks[block].edges) {
      const Eigen::Index contact = polytope_.problem.edges[static_cast<std::size_t>(k)].contact.value();
      const bool is_known = !summed.empty() && summed.back() / 2 == contact;
      for (const Eigen::Index i : {2 * contact, 2 * contact + 1}) {
        if (!is_known && coefficients[i] != 0) summed.push_back(i);
      }
    }
    const Basis* best = &polytope_.blocks[block].lightest;
    double largest = -kInfinity;
    for (const OptimalBasis& proof : extrema_.proofs) {
      const int state = extrema_.vertex(proof.contact, proof.column);
      if (proof.block != block || state < 0) continue;
      double sum = 0;
      for (const Eigen::Index i : summed) sum += coefficients[i] * extrema_.states(state, i);
      if (sum <= largest) continue;
      largest = sum;
      best = &proof.basis;
    }
    return *best;
  }

  std::vector<std::pair<int, double>> on_edges(const PolytopeBlock& block,
                                               const Eigen::VectorXd& coefficients) const {
    std::vector<std::pair<int, double>> result;
    for (std::size_t k = 0; k < block.edges.size(); ++k) {
      const Edge& edge = polytope_.problem.edges[static_cast<std::size_t>(block.edges[k])];
      const int contact = edge.contact.value();
      const double value = coefficients[2 * contact] * edge.R + coefficients[2 * contact + 1] * edge.T;
      if (value != 0) result.emplace_back(static_cast<int>(k), value);
    }
    return result;
  }

  const Packing& packing_;
  const ForcePolytope& polytope_;
  const Extrema& extrema_;
  std::vector<ReactionSum> sums_;
  std::vector<ForceBound> bounds_;
  std::vector<std::unique_ptr<BlockSearch>> blocks_;
  FoundReactions found_;
};

}  // namespace

std::vector<ReactionSum> reaction_sums(const Packing& packing) {
  const auto size = static_cast<Eigen::Index>(2 * packing.contact_count());
  std::vector<ReactionSum> sums;
  const auto add = [&](Body body, int component, auto coefficient_of) {
    ReactionSum sum{body, component, Eigen::VectorXd::Zero(size)};
    for (int i = 0; i < packing.contact_count(); ++i) {
      const Contact& contact = packing[ContactId(i)];
      const bool is_a = Body::disk(contact.a) == body;
      if (!is_a && contact.b != body) continue;
      sum.coefficients.segment<2>(2 * i) = coefficient_of(contact, is_a);
      if (contact.mu == 0) sum.coefficients[2 * i + 1] = 0;
    }
    if (!sum.coefficients.isZero(0)) sums.push_back(std::move(sum));
  };
  for (int w = 0; w < packing.wall_count(); ++w) {
    for (const int k : {0, 1})
      add(Body::wall(WallId(w)), k, [&](const Contact&, bool) { return Vector2(k == 0 ? 1 : 0, k); });
  }
  for (int i = 0; i < packing.disk_count(); ++i) {
    if (!packing[DiskId(i)].fixed) continue;
    for (const int k : {0, 1, 2}) {
      add(Body::disk(DiskId(i)), k, [&](const Contact& contact, bool is_a) {
        if (k == 2) return Vector2(0, is_a ? packing.lever_a(contact) : packing.lever_b(contact));
        const double side = is_a ? 1 : -1;
        return Vector2(side * contact.normal[k], side * contact.tangent()[k]);
      });
    }
  }
  return sums;
}

FoundReactions find_reactions(const Packing& packing, const ForcePolytope& polytope, const Extrema& extrema,
                              Formulation formulation, const LpOptions& options) {
  return ReactionFinder(packing, polytope, extrema, formulation, options).run();
}

Reactions certify_reactions(const FoundReactions& found, const std::vector<SumBounds>& bounds, bool proven) {
  Reactions r = found.reactions;
  for (std::size_t k = 0; k < found.entries.size(); ++k) {
    const Eigen::Index row = found.entries[k] / 2;
    const int end = found.entries[k] % 2;
    // The bounds are of the maximum of the sum times its sign.
    r.lower(row, end) = end == 1 ? bounds[k].lower : -bounds[k].upper;
    r.upper(row, end) = end == 1 ? bounds[k].upper : -bounds[k].lower;
    r.lower(row, end) = std::min(r.lower(row, end), r.value(row, end));
    r.upper(row, end) = std::max(r.upper(row, end), r.value(row, end));
  }
  for (Eigen::Index row = 0; row < r.count(); ++row) {
    for (const int end : {0, 1}) {
      Outcome& outcome = r.outcome(row, end);
      if (std::isinf(r.value(row, end))) {
        const bool in_doubt = outcome == Outcome::kImprecise || !proven;
        r.lower(row, end) = in_doubt && end == 1 ? -kInfinity : r.value(row, end);
        r.upper(row, end) = in_doubt && end == 0 ? kInfinity : r.value(row, end);
      }
      // Of a finite value without a bound on a side it is not known that it is the extremum.
      if (std::isfinite(r.value(row, end)) && std::isinf(r.upper(row, end) - r.lower(row, end)))
        outcome = Outcome::kImprecise;
      if (proven || std::isnan(r.value(row, end))) continue;
      outcome = Outcome::kImprecise;
      r.lower(row, end) = -kInfinity;
      r.upper(row, end) = kInfinity;
    }
  }
  return r;
}

}  // namespace indet
