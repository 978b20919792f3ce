#include "libindet/range/enclosure.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "libindet/base/constants.h"
#include "libindet/base/rounding_bounds.h"
#include "libindet/dense/lu.h"
#include "libindet/range/equation_bounds.h"
#include "libindet/range/sensitivity.h"

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
  Encloser(const ForcePolytope& polytope, const Extrema& extrema)
      : polytope_(polytope),
        problem_(polytope.problem),
        extrema_(extrema),
        first_(polytope.problem.first_unknowns()),
        equations_(polytope) {
    bound_states();
  }

  Enclosures run(std::span<const SumAtOptimum> sums) {
    sort_bases(extrema_.proofs);
    bound_strengths();
    const auto count = static_cast<Eigen::Index>(problem_.contacts.size());
    for (auto* table : {&enclosures_.lower, &enclosures_.upper, &enclosures_.sensitivity})
      table->setConstant(count, 4, kNaN);
    for (Eigen::Index i = 0; i < count; ++i) {
      for (int column = 0; column < 4; ++column) {
        if (extrema_.vertex(i, column) >= 0) enclose(i, column);
      }
    }
    const bool limited = polytope_.status != PolytopeStatus::kBounded || std::isfinite(total_);
    enclosures_.proven = !polytope_.doubtful && inside_ && limited;
    for (const SumAtOptimum& sum : sums) enclosures_.sums.push_back(enclose_sum(sum));
    return std::move(enclosures_);
  }

 private:
  /// A linear functional by its coefficients on the unknowns u and on the edges x, ascending. Where these are
  /// sums in which digits cancel, `sizes` are those of their parts.
  struct Functional {
    std::vector<std::pair<int, double>> on_unknowns, on_edges;
    std::vector<double> unknown_sizes, edge_sizes;  ///< empty: the sizes of the coefficients
    double edge_size(std::size_t k) const {
      return edge_sizes.empty() ? std::abs(on_edges[k].second) : edge_sizes[k];
    }
    double unknown_size(std::size_t k) const {
      return unknown_sizes.empty() ? std::abs(on_unknowns[k].second) : unknown_sizes[k];
    }
  };

  Functional functional(const Eigen::VectorXd& on_forces) const {
    Functional f;
    for (int k = 0; k < problem_.unknowns(); ++k) {
      const Edge& edge = problem_.edge(k);
      const double on_R = on_forces[2 * edge.contact.value()];
      const double on_T = on_forces[2 * edge.contact.value() + 1];
      if (edge.is_slack() || (on_R == 0 && on_T == 0)) continue;
      f.on_edges.emplace_back(k, on_R * edge.R + on_T * edge.T);
      f.edge_sizes.push_back(std::abs(on_R * edge.R) + std::abs(on_T * edge.T));
      if (problem_.is_stick(edge)) {  // its unknowns are R, then T
        f.on_unknowns.emplace_back(k, edge.sign > 0 ? on_R : on_T);
        f.unknown_sizes.push_back(std::abs(f.on_unknowns.back().second));
      } else {
        f.on_unknowns.push_back(f.on_edges.back());
        f.unknown_sizes.push_back(f.edge_sizes.back());
      }
    }
    return f;
  }

  Functional functional(Eigen::Index contact, bool tangential, double sign) const {
    Functional f;
    const int first = first_[static_cast<std::size_t>(contact)];
    if (first < 0) return f;
    const int edges = problem_.is_stick(problem_.edge(first)) ? 2 : 1;
    for (int k = first; k < first + edges; ++k) {
      const Edge& edge = problem_.edge(k);
      const double coefficient = sign * (tangential ? edge.T : edge.R);
      f.on_edges.emplace_back(k, coefficient);
      if (edges == 1) f.on_unknowns.emplace_back(k, coefficient);
    }
    if (edges == 2) f.on_unknowns.emplace_back(first + (tangential ? 1 : 0), sign);
    return f;
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
    inside_ = extrema_.states.rows() > 0 && std::isfinite(centre_.shift);
    for_each_slack(centre_.u, centre_.shift, [&](int k, double slack) {
      margin_[k] = slack;
      inside_ = inside_ && slack > 0;
    });
    for (Eigen::Index row = 0; row < extrema_.states.rows(); ++row)
      states_.push_back(bound_of(problem_.units.internal(SceneForces(extrema_.states.row(row).transpose()))));
  }

  void sort_bases(const std::vector<OptimalBasis>& optima) {
    basis_of_.setConstant(static_cast<Eigen::Index>(problem_.contacts.size()), 4, -1);
    std::map<std::pair<std::size_t, Basis>, int> numbers;
    for (const OptimalBasis& optimum : optima) {
      const auto [entry, is_new] =
          numbers.emplace(std::make_pair(optimum.block, optimum.basis), static_cast<int>(factors_.size()));
      if (is_new) {
        const SlopeView& view = polytope_.blocks[optimum.block].view;
        factors_.push_back({optimum.block, optimum.basis,
                            Eigen::PartialPivLU<Eigen::MatrixXd>(view.slope(optimum.basis, Eigen::all))});
      }
      basis_of_(optimum.contact, optimum.column) = entry->second;
    }
  }

  struct Factor {
    std::size_t block;
    Basis basis;
    Eigen::PartialPivLU<Eigen::MatrixXd> active;
  };

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
    if (number >= 0) add_reduced_costs(f, factors_[static_cast<std::size_t>(number)], y);
    return y;
  }

  void add_reduced_costs(const Functional& f, const Factor& factor, Eigen::VectorXd& y) const {
    const PolytopeBlock& block = polytope_.blocks[factor.block];
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(block.view.dim());
    for (const auto& [edge, coefficient] : f.on_edges) {
      const auto local = std::lower_bound(block.edges.begin(), block.edges.end(), edge);
      if (local != block.edges.end() && *local == edge)
        gradient += coefficient * block.view.slope.row(local - block.edges.begin()).transpose();
    }
    const Eigen::VectorXd costs = factor.active.transpose().solve(gradient);
    for (Eigen::Index k = 0; k < costs.size(); ++k) {
      const int edge = block.edges[static_cast<std::size_t>(factor.basis[static_cast<std::size_t>(k)])];
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
      if (extrema_.vertex(i, kMaxR) < 0 || k != first_[static_cast<std::size_t>(i)]) continue;
      const Functional f = functional(i, false, 1);
      const Eigen::VectorXd y_of_maximum = multipliers(f, basis_of_(i, kMaxR));
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

  static double value_at(const Functional& f, const Eigen::VectorXd& u) {
    double value = 0;
    for (const auto& [unknown, coefficient] : f.on_unknowns) value += coefficient * u[unknown];
    return value;
  }

  /// Lower bound of max f: f at an admissible state near the stored one.
  double from_below(const Functional& f, const StateBound& state) const {
    if (!inside_ || !std::isfinite(state.shift)) return -kInfinity;
    const double value = value_at(f, state.u);
    const double middle = value_at(f, centre_.u);
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

  double sensitivity_of(const Eigen::VectorXd& y, Eigen::Index state) const {
    Eigen::VectorXd motion = Eigen::VectorXd::Zero(problem_.equations());
    for (std::size_t k = 0; k < equations_.rows().size(); ++k)
      motion[equations_.rows()[k]] = y[static_cast<Eigen::Index>(k)];
    return sensitivity_to_normals(problem_, motion, SceneForces(extrema_.states.row(state).transpose()));
  }

  void enclose(Eigen::Index i, int column) {
    const double sign = column == kMaxR || column == kMaxT ? 1 : -1;
    const Eigen::Index row = extrema_.vertex(i, column);
    const StateBound& state = states_[static_cast<std::size_t>(row)];
    const double stored = extrema_.states(row, 2 * i + (column >= kMinT ? 1 : 0));
    double inner = 0;
    double outer = 0;
    const Functional f = functional(i, column >= kMinT, sign);
    if (f.on_edges.empty()) {  // closed throughout F: exactly 0
      enclosures_.sensitivity(i, column) = 0;
    } else {
      const Eigen::VectorXd y = multipliers(f, basis_of_(i, column));
      outer = from_above(f, y);
      inner = from_below(f, state);
      if (basis_of_(i, column) < 0) {
        // Determined: the same bound from the other side holds for every state.
        inner = std::max(inner, -from_above(opposite_of(f), -y));
      }
      enclosures_.sensitivity(i, column) = sensitivity_of(y, row);
    }
    const double unit = problem_.units.internal_in_scene();
    const double low = sign > 0 ? inner : -outer;
    const double high = sign > 0 ? outer : -inner;
    enclosures_.lower(i, column) = std::min(stored, widened(low, -1, unit));
    enclosures_.upper(i, column) = std::max(stored, widened(high, 1, unit));
  }

  static Functional opposite_of(Functional f) {
    for (auto* part : {&f.on_unknowns, &f.on_edges}) {
      for (auto& entry : *part) entry.second = -entry.second;
    }
    return f;
  }

  SumBounds enclose_sum(const SumAtOptimum& sum) const {
    const Functional f = functional(sum.coefficients);
    Eigen::VectorXd y = Eigen::VectorXd::Zero(equations_.rank());
    for (const auto& [unknown, coefficient] : f.on_unknowns) add_unknown(unknown, coefficient, y);
    for (const auto& [block, basis] : sum.bases) {
      const SlopeView& view = polytope_.blocks[block].view;
      add_reduced_costs(
          f, {block, basis, Eigen::PartialPivLU<Eigen::MatrixXd>(view.slope(basis, Eigen::all))}, y);
    }
    const double outer = from_above(f, y);
    double inner = from_below(f, bound_of(sum.state));
    if (sum.bases.empty()) inner = std::max(inner, -from_above(opposite_of(f), -y));
    const double unit = problem_.units.internal_in_scene();
    return {widened(inner, -1, unit), widened(outer, 1, unit)};
  }

  /// A bound in the scene's units.
  static double widened(double bound, double direction, double unit) {
    if (std::isinf(bound)) return bound;
    return bound * unit + direction * (4 * kRoundoff * std::abs(bound) * unit + kTiny * unit);
  }

  const ForcePolytope& polytope_;
  const EquilibriumProblem& problem_;
  const Extrema& extrema_;
  Enclosures enclosures_;
  std::vector<int> first_;  ///< of each contact its first unknown, −1 if it is open
  EquationBounds equations_;
  std::vector<StateBound> states_;
  StateBound centre_;
  Eigen::VectorXd margin_;  ///< slack of the centre at each edge
  bool inside_ = false;     ///< the centre is proven to be strictly inside
  Eigen::Array<int, Eigen::Dynamic, 4, Eigen::RowMajor> basis_of_;
  std::vector<Factor> factors_;
  double total_ = kInfinity;  ///< bound of ΣR over F
  Eigen::VectorXd strength_;  ///< X
};

}  // namespace

Enclosures enclose_values(const ForcePolytope& polytope, const Extrema& extrema,
                          std::span<const SumAtOptimum> sums) {
  if (polytope.status != PolytopeStatus::kEmpty) return Encloser(polytope, extrema).run(sums);
  Enclosures none;
  for (auto* table : {&none.lower, &none.upper, &none.sensitivity})
    table->setConstant(static_cast<Eigen::Index>(polytope.problem.contacts.size()), 4, kNaN);
  none.proven = !polytope.doubtful;
  return none;
}

}  // namespace indet
