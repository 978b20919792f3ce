#include "libindet/range/enclosure.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "libindet/base/constants.h"
#include "libindet/base/error.h"
#include "libindet/base/rounding_bounds.h"
#include "libindet/range/central_enclosure.h"
#include "libindet/range/equation_bounds.h"
#include "libindet/range/functional.h"
#include "libindet/range/proof_bases.h"
#include "libindet/range/sensitivity_bounds.h"
#include "libindet/range/state_table.h"

namespace indet {
namespace {

/// What is known of a stored state: the exact solution nearest to it is within `shift` of it, entry by entry.
struct StateBound {
  Eigen::VectorXd u;
  double shift = kInfinity;
  double share = 1;  ///< θ: how far it must be moved towards the centre
};

class Encloser {
 public:
  Encloser(const ForcePolytope& polytope, const Extrema& extrema, const StageProgress& progress)
      : polytope_(polytope),
        problem_(polytope.problem),
        extrema_(extrema),
        progress_(progress),
        first_(polytope.problem.first_unknowns()),
        equations_(polytope),
        sensitivity_(polytope, extrema.value) {
    bound_states();
  }

  Enclosures run(std::span<const SumAtOptimum> sums) {
    const auto count = static_cast<Eigen::Index>(problem_.contacts.size());
    inner_.setConstant(count, 4, -kInfinity);
    for (auto* table : {&enclosures_.lower, &enclosures_.upper}) table->setConstant(count, 4, kNaN);
    enclosures_.sensitivity.clear(count);
    read_proofs();
    bound_strengths();
    for (Eigen::Index i = 0; i < count; ++i) {
      for (int column = 0; column < 4; ++column) {
        if (!std::isnan(extrema_.value(i, column))) enclose(i, column);
      }
      if (progress_ && !progress_(i, count)) throw Interrupted();
    }
    const bool limited = polytope_.status != PolytopeStatus::kBounded || std::isfinite(total_);
    enclosures_.proven = !polytope_.doubtful && inside_ && limited;
    for (const SumAtOptimum& sum : sums) enclosures_.sums.push_back(enclose_sum(sum));
    return std::move(enclosures_);
  }

 private:
  Functional functional(Eigen::Index contact, int column) const {
    const double sign = column == kMaxR || column == kMaxT ? 1 : -1;
    return force_component(problem_, first_, contact, column >= kMinT, sign);
  }

  /// Visits each edge with its smallest slack once the point has been corrected.
  template <class Visit>
  void for_each_slack(const Eigen::VectorXd& u, double shift, Visit visit) const {
    for (int k = 0; k < problem_.unknowns(); ++k) {
      const Edge& edge = problem_.edge(k);
      if (!problem_.is_stick(edge)) {
        visit(k, u[k] - shift);
        continue;
      }
      const double mu = problem_.mu(edge);
      const int R = edge.sign > 0 ? k : k - 1;
      const double slack = mu * u[R] + edge.sign * u[R + 1];
      const double rounding = 4 * kRoundoff * (mu * std::abs(u[R]) + std::abs(u[R + 1]));
      visit(k, slack - kWiden * ((mu + 1) * shift + rounding) - kTiny);
    }
  }

  StateBound bound_of(const InternalForces& state) const {
    StateBound bound;
    bound.u = problem_.unknowns_of(state);
    bound.shift = equations_.distance_to_solution(bound.u);
    bound.share = inside_ ? 0 : 1;
    for_each_slack(bound.u, bound.shift, [&](int k, double slack) {
      if (slack < 0 && inside_) bound.share = std::max(bound.share, kWiden * -slack / (margin_[k] - slack));
    });
    if (!(bound.share <= 1)) bound.share = 1;
    return bound;
  }

  void bound_states() {
    centre_.u = problem_.unknowns_of(problem_.state(polytope_.interior));
    centre_.shift = equations_.distance_to_solution(centre_.u);
    margin_.resize(problem_.unknowns());
    const bool has_state = !extrema_.value.isNaN().all();
    inside_ = has_state && std::isfinite(centre_.shift);
    for_each_slack(centre_.u, centre_.shift, [&](int k, double slack) {
      margin_[k] = slack;
      inside_ = inside_ && slack > 0;
    });
    for (Eigen::Index row = 0; row < extrema_.states.rows(); ++row)
      states_.push_back(bound_of(problem_.units.internal(SceneForces(extrema_.states.row(row).transpose()))));
  }

  /// Reads the reduced costs of every objective at the basis that proves it; and there, where its state is
  /// not kept, what the state tells.
  void read_proofs() {
    const std::vector<OptimalBasis>& proofs = extrema_.proofs;
    proof_of_.setConstant(static_cast<Eigen::Index>(problem_.contacts.size()), 4, -1);
    for (std::size_t k = 0; k < proofs.size(); ++k)
      proof_of_(proofs[k].contact, proofs[k].column) = static_cast<int>(k);
    costs_.resize(proofs.size());
    for_each_basis(polytope_, proofs, [&](const ProofBasis& basis, std::span<const std::size_t> numbers) {
      std::optional<SceneForces> forces;
      std::optional<StateBound> bound;
      for (const std::size_t k : numbers) {
        const auto [i, column] = std::pair(proofs[k].contact, proofs[k].column);
        const Functional f = functional(i, column);
        costs_[k] = reduced_costs(f, basis.block, basis.vertex);
        if (!forces) forces = problem_.units.scene(state_at(polytope_, basis.block, basis.vertex));
        enclosures_.sensitivity.set(
            i, column,
            sensitivity_.at_vertex(i, column, basis.block, basis.vertex, -costs_[k], *forces,
                                   [&](const Eigen::VectorXd& costs) { return motion_of(f, costs); }));
        if (extrema_.vertex(i, column) >= 0) continue;
        if (!bound) bound = bound_of(problem_.units.internal(*forces));
        inner_(i, column) = from_below(f, *bound);
      }
    });
  }

  /// Adds Pᵀ times a multiple of the functional u_i.
  void add_unknown(int unknown, double weight, Eigen::VectorXd& y) const {
    if (weight != 0) y += weight * equations_.right_inverse().row(unknown).transpose();
  }
  /// … of the functional x_k.
  void add_edge(int k, double weight, Eigen::VectorXd& y) const {
    const Edge& edge = problem_.edge(k);
    if (!problem_.is_stick(edge)) return add_unknown(k, weight, y);
    const int R = edge.sign > 0 ? k : k - 1;
    add_unknown(R, weight * 0.5 / edge.R, y);
    add_unknown(R + 1, edge.sign * weight * 0.5 / (edge.R * problem_.mu(edge)), y);
  }

  /// y for max f, from the reduced costs at its basis.
  Eigen::VectorXd multipliers(const Functional& f, int number) const {
    Eigen::VectorXd y = Eigen::VectorXd::Zero(equations_.rank());
    for (const auto& [unknown, coefficient] : f.on_unknowns) add_unknown(unknown, coefficient, y);
    if (number >= 0) {
      const OptimalBasis& proof = extrema_.proofs[static_cast<std::size_t>(number)];
      add_reduced_costs(proof.block, proof.basis, costs_[static_cast<std::size_t>(number)], y);
    }
    return y;
  }

  /// −λ of the vertex's active inequalities.
  Eigen::VectorXd reduced_costs(const Functional& f, std::size_t number, const Vertex& vertex) const {
    return -vertex.multipliers(objective_on(polytope_.blocks[number], f));
  }

  void add_reduced_costs(std::size_t block, const Basis& basis, const Eigen::VectorXd& costs,
                         Eigen::VectorXd& y) const {
    for (Eigen::Index k = 0; k < costs.size(); ++k) {
      const int edge =
          polytope_.blocks[block].edges[static_cast<std::size_t>(basis[static_cast<std::size_t>(k)])];
      add_edge(edge, std::max(0.0, -costs[k]), y);
    }
  }

  /// Upper bounds of h_k = f_k − (Aᵀ y)_k on edges, where positive.
  template <class Visit>
  void for_each_excess(const Functional& f, const Eigen::VectorXd& y, Visit visit) const {
    std::size_t next = 0;
    for (int k = 0; k < equations_.edge_matrix().outerSize(); ++k) {
      double sum = 0;
      double magnitude = 0;
      if (next < f.on_edges.size() && f.on_edges[next].first == k) {
        sum = f.on_edges[next].second;
        magnitude = f.edge_size(next++);
      }
      double plain = 0;
      int terms = 4;
      for (Eigen::SparseMatrix<double>::InnerIterator it(equations_.edge_matrix(), k); it; ++it) {
        const double product = it.value() * y[it.row()];
        sum -= product;
        magnitude += std::abs(product);
        plain += equations_.entry_error(it.row()) * std::abs(y[it.row()]);
        ++terms;
      }
      const double excess = sum + kWiden * kRoundoff * (terms * magnitude + 8 * plain);
      if (!(excess <= 0)) visit(k, excess);
    }
  }

  /// The largest excess of any edge.
  double worst_excess(const Functional& f, const Eigen::VectorXd& y) const {
    double worst = 0;
    for_each_excess(
        f, y, [&](int, double excess) { worst = std::isnan(excess) ? kInfinity : std::max(worst, excess); });
    return worst;
  }

  /// X_k: Σx is limited because the polytope is, and each x_k by the certificate of the largest normal force
  /// of its contact, where that was asked for.
  void bound_strengths() {
    strength_.setConstant(problem_.unknowns(), kInfinity);
    total_ = kInfinity;
    if (polytope_.bounding_multipliers.size() == 0 || !equations_.is_proven()) return;
    Functional sum;
    Eigen::VectorXd y = Eigen::VectorXd::Zero(equations_.rank());
    for (int k = 0; k < problem_.unknowns(); ++k) {
      sum.on_edges.emplace_back(k, 1);
      add_edge(k, 1 + polytope_.bounding_multipliers[k], y);
    }
    const double share = worst_excess(sum, y);
    if (!(share < 0.5)) return;
    total_ = std::max(0.0, kWiden * equations_.load_bound(y) / (1 - kWiden * share));
    strength_.setConstant(total_);
    for (int k = 0; k < problem_.unknowns(); ++k) {
      const Edge& edge = problem_.edge(k);
      const Eigen::Index i = edge.contact.value();
      if (std::isnan(extrema_.value(i, kMaxR)) || k != first_[static_cast<std::size_t>(i)]) continue;
      const Functional f = functional(i, kMaxR);
      const Eigen::VectorXd y_of_maximum = multipliers(f, proof_of_(i, kMaxR));
      const double R = equations_.load_bound(y_of_maximum) + worst_excess(f, y_of_maximum) * total_;
      for (const auto& [own, coefficient] : f.on_edges)
        strength_[own] = std::min(total_, kWiden * kWiden * std::max(0.0, R) / coefficient);
    }
  }

  /// Upper bound of max f over F.
  double from_above(const Functional& f, const Eigen::VectorXd& y) const {
    if (!equations_.is_proven() && equations_.rank() > 0) return kInfinity;
    double bound = equations_.load_bound(y);
    double excesses = 0;
    for_each_excess(f, y, [&](int k, double excess) {
      excesses += excess * strength_[k];
      if (std::isnan(excess)) excesses = kInfinity;
    });
    bound += kWiden * excesses;
    return std::isnan(bound) ? kInfinity : bound;
  }

  /// Lower bound of max f: f at an admissible state near the stored one.
  double from_below(const Functional& f, const StateBound& state) const {
    if (!inside_ || !std::isfinite(state.shift)) return -kInfinity;
    const double value = f.at(state.u);
    const double middle = f.at(centre_.u);
    double reach = 0;
    double size = 0;
    for (std::size_t k = 0; k < f.on_unknowns.size(); ++k) {
      reach += f.unknown_size(k);
      const int unknown = f.on_unknowns[k].first;
      size += f.unknown_size(k) * (std::abs(state.u[unknown]) + std::abs(centre_.u[unknown]));
    }
    const double terms = 3 + static_cast<double>(f.on_unknowns.size());
    const double slack = reach * (state.shift + centre_.shift) + terms * kRoundoff * size;
    return value - kWiden * (slack + state.share * std::abs(value - middle)) - kTiny;
  }

  /// y with Aᵀ y = f + costs, one entry an equation of the problem.
  Eigen::VectorXd motion_of(const Functional& f, const Eigen::VectorXd& costs) const {
    Eigen::VectorXd y = multipliers(f, -1);
    for (int k = 0; k < costs.size(); ++k) add_edge(k, costs[k], y);
    return on_problem(y);
  }
  Eigen::VectorXd on_problem(const Eigen::VectorXd& y) const {
    Eigen::VectorXd motion = Eigen::VectorXd::Zero(problem_.equations());
    for (std::size_t k = 0; k < equations_.rows().size(); ++k)
      motion[equations_.rows()[k]] = y[static_cast<Eigen::Index>(k)];
    return motion;
  }

  /// The state of determined values: the one that all of them share.
  void read_lightest() {
    if (lightest_) return;
    lightest_ = problem_.units.scene(problem_.state(polytope_.lightest));
    lightest_bound_ = bound_of(problem_.units.internal(*lightest_));
  }

  void enclose(Eigen::Index i, int column) {
    const double sign = column == kMaxR || column == kMaxT ? 1 : -1;
    const Eigen::Index row = extrema_.vertex(i, column);
    const double stored = extrema_.value(i, column);
    double inner = 0;
    double outer = 0;
    const Functional f = functional(i, column);
    if (f.on_edges.empty()) {  // closed throughout F: exactly 0
      enclosures_.sensitivity.set(i, column, sensitivity_.closed(i, column));
    } else {
      const bool is_determined = proof_of_(i, column) < 0;
      const Eigen::VectorXd y = multipliers(f, proof_of_(i, column));
      outer = from_above(f, y);
      if (is_determined) {
        read_lightest();
        enclosures_.sensitivity.set(i, column, sensitivity_.everywhere(i, column, on_problem(y), *lightest_));
      }
      if (row >= 0)
        inner_(i, column) = from_below(f, states_[static_cast<std::size_t>(row)]);
      else if (is_determined)
        inner_(i, column) = from_below(f, lightest_bound_);
      inner = inner_(i, column);
      // The same bound from the other side holds for every state.
      if (is_determined) inner = std::max(inner, -from_above(f.opposite(), -y));
    }
    const double unit = problem_.units.internal_in_scene();
    const double least_possible =
        column == kMinR || column == kMaxR ? 0 : -kInfinity;  // contacts do not pull
    const double low = std::max(least_possible, sign > 0 ? inner : -outer);
    const double high = sign > 0 ? outer : -inner;
    enclosures_.lower(i, column) = std::min(stored, widened(low, -1, unit));
    enclosures_.upper(i, column) = std::max(stored, widened(high, 1, unit));
  }

  SumBounds enclose_sum(const SumAtOptimum& sum) const {
    const Functional f = sum_of_forces(problem_, sum.coefficients);
    Eigen::VectorXd y = Eigen::VectorXd::Zero(equations_.rank());
    for (const auto& [unknown, coefficient] : f.on_unknowns) add_unknown(unknown, coefficient, y);
    for (const auto& [block, basis] : sum.bases) {
      const Vertex vertex = locate_vertex(polytope_.blocks[block].view, basis);
      add_reduced_costs(block, basis, reduced_costs(f, block, vertex), y);
    }
    const double outer = from_above(f, y);
    double inner = from_below(f, bound_of(sum.state));
    if (sum.bases.empty()) inner = std::max(inner, -from_above(f.opposite(), -y));
    const double unit = problem_.units.internal_in_scene();
    return {widened(inner, -1, unit), widened(outer, 1, unit)};
  }

  /// A bound in the scene's units.
  static double widened(double bound, double direction, double unit) {
    if (std::isinf(bound) || bound == 0) return bound;
    return bound * unit + direction * (4 * kRoundoff * std::abs(bound) * unit + kTiny * unit);
  }

  const ForcePolytope& polytope_;
  const EquilibriumProblem& problem_;
  const Extrema& extrema_;
  const StageProgress& progress_;
  Enclosures enclosures_;
  std::vector<int> first_;  ///< of each contact its first unknown, −1 if it is open
  EquationBounds equations_;
  SensitivityBounds sensitivity_;
  std::vector<StateBound> states_;
  StateBound centre_;
  Eigen::VectorXd margin_;              ///< slack of the centre at each edge
  bool inside_ = false;                 ///< the centre is proven to be strictly inside
  Table4<int> proof_of_;                ///< number of its proof; −1: none
  std::vector<Eigen::VectorXd> costs_;  ///< of each proof, −λ of its basis
  Table4<double> inner_;                ///< bound from below of each maximum, from above of each minimum
  std::optional<SceneForces> lightest_;
  StateBound lightest_bound_;
  double total_ = kInfinity;  ///< bound of ΣR over F
  Eigen::VectorXd strength_;  ///< X
};

}  // namespace

Enclosures enclose_values(const ForcePolytope& polytope, const Extrema& extrema,
                          std::span<const SumAtOptimum> sums, const StageProgress& progress) {
  if (polytope.central) return enclose_by_centre(polytope, extrema, sums, progress);
  if (polytope.status != PolytopeStatus::kEmpty) return Encloser(polytope, extrema, progress).run(sums);
  Enclosures none;
  const auto count = static_cast<Eigen::Index>(polytope.problem.contacts.size());
  for (auto* table : {&none.lower, &none.upper}) table->setConstant(count, 4, kNaN);
  none.sensitivity.clear(count);
  none.proven = !polytope.doubtful;
  return none;
}

}  // namespace indet
