#include "libindet/range/enclosure.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "libindet/base/constants.h"
#include "libindet/base/error.h"
#include "libindet/base/rounding_bounds.h"
#include "libindet/range/basis_system.h"
#include "libindet/range/doubled_equations.h"
#include "libindet/range/proof_bases.h"
#include "libindet/range/sensitivity_bounds.h"
#include "libindet/range/solution_bounds.h"
#include "libindet/range/state_table.h"
#include "libindet/range/tilted_multipliers.h"
#include "libindet/range/unlimited_edges.h"

namespace indet {
namespace {

constexpr Sensitivity kNotKnown{kInfinity, SensitivityClaim::kBound};

class Encloser {
 public:
  Encloser(const ForcePolytope& polytope, const Extrema& extrema, const StageProgress& progress)
      : polytope_(polytope),
        problem_(polytope.problem),
        extrema_(extrema),
        progress_(progress),
        first_(polytope.problem.first_unknowns()),
        unit_(polytope.problem.units.internal_in_scene()),
        widen_(kWiden + 4 * kRoundoff * (polytope.problem.equations() + polytope.problem.unknowns())),
        equations_(polytope),
        lightest_(polytope, equations_),
        everywhere_(polytope, equations_, lightest_, {}),
        unlimited_(polytope),
        bounds_(polytope, equations_, lightest_, everywhere_, unlimited_),
        sensitivity_(polytope, extrema.value),
        at_lightest_(point_of(everywhere_)) {}

  Enclosures run(std::span<const SumAtOptimum> sums) {
    const auto count = static_cast<Eigen::Index>(problem_.contacts.size());
    for (auto* table : {&enclosures_.lower, &enclosures_.upper}) table->setConstant(count, 4, kNaN);
    enclosures_.sensitivity.clear(count);
    enclose_proofs();
    for (Eigen::Index i = 0; i < count; ++i) {
      for (int column = 0; column < 4; ++column) {
        if (std::isnan(enclosures_.lower(i, column)) && !std::isnan(extrema_.value(i, column)))
          enclose_determined(i, column);
      }
    }
    const bool limited =
        polytope_.status != PolytopeStatus::kBounded || bounds_.strength().array().isFinite().all();
    enclosures_.proven = !polytope_.doubtful && bounds_.has_interior() && limited;
    for (const SumAtOptimum& sum : sums) enclosures_.sums.push_back(enclose_sum(sum));
    return std::move(enclosures_);
  }

 private:
  /// Near a state is an exact solution, within `reach` times `shift`; and moved by `share` of the way to the
  /// one inside it is an admissible state.
  struct Point {
    std::vector<Doubled> x;
    double shift = kInfinity, share = 1;
  };

  Point point_of(const BasisSystem& system) const {
    BasisSystem::Solution state = system.state();
    Point point{std::move(state.value), bounds_.shift(state.residual), 0};
    if (!bounds_.has_interior() || !std::isfinite(point.shift)) return {std::move(point.x), kInfinity, 1};
    for (std::size_t k = 0; k < point.x.size(); ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      const double x = point.x[k].high;
      const double left = x - widen_ * (4 * kRoundoff * std::abs(x) + bounds_.reach()[i] * point.shift);
      if (!(left >= 0)) point.share = std::fmax(point.share, widen_ * -left / (bounds_.margin()[i] - left));
      if (std::isnan(left)) point.share = 1;
    }
    point.share = std::min(1.0, point.share);
    return point;
  }

  /// In the scene's units, no smaller than value + error.
  double above(const Doubled& value, double error) const {
    const Doubled scaled = product(value, unit_);
    const double room = unit_ * (error + kTiny) + 16 * kRoundoff * kRoundoff * std::abs(scaled.high) +
                        8 * std::numeric_limits<double>::denorm_min();
    const double bound = std::nextafter(scaled.high + (scaled.low + kWiden * room), kInfinity);
    return std::isnan(bound) ? kInfinity : bound;
  }

  /// Upper bound of max g over F from any y.
  double from_above(const BasisSystem& system, const DoubledFunctional& g, bool is_level) const {
    return from_above(system, g, is_level, system.multipliers(g));
  }
  double from_above(const BasisSystem& system, const DoubledFunctional& g, bool is_level,
                    const BasisSystem::Solution& y) const {
    const double bound = is_level ? dual_bound(y, unlimited_.shift(y.residual)) : kInfinity;
    if (std::isfinite(bound)) return bound;
    const auto tilted = tilted_multipliers(equations_, system, g, y.value, bounds_.strength());
    return tilted ? dual_bound(*tilted, 0) : kInfinity;
  }
  /// From multipliers within a shift of y (UnlimitedEdges); without one, h ≤ 0 on the unlimited edges.
  double dual_bound(const BasisSystem::Solution& y, double shift) const {
    if (!std::isfinite(shift)) return kInfinity;
    double excess = 0;
    for (int k = 0; k < problem_.unknowns(); ++k) {
      if (unlimited_.contains(k)) continue;
      const double h = y.residual.value[k] + widen_ * (y.residual.error[k] + shift * unlimited_.reach()[k]);
      if (!(h <= 0)) excess += h * bounds_.strength()[k];
    }
    const BoundedNumber load = equations_.load_product(y.value);
    return above(load.value, load.error + widen_ * (excess + shift * unlimited_.load_reach()));
  }

  /// Lower bound of max g over F: g at an admissible state near the point.
  double from_below(const DoubledFunctional& g, const Point& point) const {
    if (!std::isfinite(point.shift)) return -kInfinity;
    const BoundedNumber value = DoubledEquations::value(g, point.x);
    double middle = 0, size = 0, reach = 0;
    for (const auto& [k, coefficient] : g) {
      middle += coefficient.high * bounds_.interior()[k];
      size += std::abs(coefficient.high) *
              (bounds_.interior()[k] + std::abs(point.x[static_cast<std::size_t>(k)].high));
      reach += std::abs(coefficient.high) * bounds_.reach()[k];
    }
    const double distance =
        std::abs(value.value.high - middle) + 4 * kRoundoff * (static_cast<double>(g.size()) + 4) * size;
    const double slack =
        value.error +
        widen_ * (point.share * distance + reach * (point.shift + point.share * bounds_.interior_shift()));
    return -above({-value.value.high, -value.value.low}, widen_ * slack);
  }

  void tell_progress() {
    if (progress_ && !progress_(done_++, std::ssize(extrema_.proofs))) throw Interrupted();
  }

  static double sign_of(int column) { return column == kMaxR || column == kMaxT ? 1 : -1; }
  DoubledFunctional functional(Eigen::Index contact, int column) const {
    return doubled_component(problem_, first_, contact, column >= kMinT, sign_of(column));
  }
  bool is_level(Eigen::Index contact, int column) const {
    const std::pair<int, double> force(static_cast<int>(2 * contact) + (column >= kMinT ? 1 : 0), 1.0);
    return unlimited_.is_level({&force, 1});
  }
  /// y with Aᵀ y = g + costs.
  Eigen::VectorXd motion_of(const DoubledFunctional& g, Eigen::VectorXd costs) const {
    for (const auto& [k, coefficient] : g) costs[k] += coefficient.high;
    return lightest_.motion(costs);
  }

  void enclose_proofs() {
    for_each_basis(
        polytope_, extrema_.proofs, [&](const ProofBasis& basis, std::span<const std::size_t> numbers) {
          const BasisSystem system(polytope_, equations_, lightest_, {{basis.block, &basis.vertex}});
          const Point point = point_of(system);
          const std::vector<int>& edges = polytope_.blocks[basis.block].edges;
          const SceneForces forces = problem_.units.scene(state_at(polytope_, basis.block, basis.vertex));
          for (const std::size_t number : numbers) {
            tell_progress();
            const auto [i, column] =
                std::pair(extrema_.proofs[number].contact, extrema_.proofs[number].column);
            const DoubledFunctional g = functional(i, column);
            if (g.empty()) continue;
            const BasisSystem::Solution y = system.multipliers(g);
            store(i, column, from_below(g, point), from_above(system, g, is_level(i, column), y));
            Eigen::VectorXd costs(std::ssize(basis.vertex.basis));
            for (std::size_t k = 0; k < basis.vertex.basis.size(); ++k) {
              const int edge = edges[static_cast<std::size_t>(basis.vertex.basis[k])];
              costs[static_cast<Eigen::Index>(k)] = -y.residual.value[edge];
            }
            if (lightest_.is_regular()) {
              enclosures_.sensitivity.set(
                  i, column,
                  sensitivity_.at_vertex(i, column, basis.block, basis.vertex, costs, forces,
                                         [&](const Eigen::VectorXd& other) { return motion_of(g, other); }));
            } else {
              enclosures_.sensitivity.set(i, column, kNotKnown);
            }
          }
        });
  }

  void enclose_determined(Eigen::Index i, int column) {
    const DoubledFunctional g = functional(i, column);
    if (g.empty()) {  // closed throughout F: exactly 0
      enclosures_.lower(i, column) = enclosures_.upper(i, column) = 0;
      enclosures_.sensitivity.set(i, column, sensitivity_.closed(i, column));
      return;
    }
    const auto [lower, upper] = everywhere(g, is_level(i, column));
    store(i, column, lower, upper);
    if (!lightest_.is_regular()) return enclosures_.sensitivity.set(i, column, kNotKnown);
    const Eigen::VectorXd motion = motion_of(g, Eigen::VectorXd::Zero(problem_.unknowns()));
    const SceneForces forces = problem_.units.scene(problem_.state(polytope_.lightest));
    enclosures_.sensitivity.set(i, column, sensitivity_.everywhere(i, column, motion, forces));
  }

  /// Of a functional that is the same throughout F: the bound from above holds from the other side, too.
  SumBounds everywhere(const DoubledFunctional& g, bool is_level) const {
    const double from_other_side = -from_above(everywhere_, opposite(g), is_level);
    return {std::max(from_below(g, at_lightest_), from_other_side), from_above(everywhere_, g, is_level)};
  }

  /// `inner`, `outer`: of the maximum of the functional.
  void store(Eigen::Index i, int column, double inner, double outer) {
    const double stored = extrema_.value(i, column);
    const double least_possible =
        column == kMinR || column == kMaxR ? 0 : -kInfinity;  // contacts do not pull
    const bool is_maximum = sign_of(column) > 0;
    enclosures_.lower(i, column) = std::min(stored, std::max(least_possible, is_maximum ? inner : -outer));
    enclosures_.upper(i, column) = std::max(stored, is_maximum ? outer : -inner);
  }

  SumBounds enclose_sum(const SumAtOptimum& sum) const {
    const DoubledFunctional g = doubled_sum(problem_, sum.coefficients);
    std::vector<std::pair<int, double>> on_forces;
    for (Eigen::Index c = 0; c < sum.coefficients.size(); ++c) {
      if (sum.coefficients[c] != 0) on_forces.emplace_back(static_cast<int>(c), sum.coefficients[c]);
    }
    const bool is_level = unlimited_.is_level(on_forces);
    if (sum.bases.empty()) return everywhere(g, is_level);
    std::vector<Vertex> located;
    for (const auto& [block, basis] : sum.bases)
      located.push_back(locate_vertex(polytope_.blocks[block].view, basis));
    BasisSystem::Vertices vertices;
    for (std::size_t k = 0; k < located.size(); ++k) vertices.emplace_back(sum.bases[k].first, &located[k]);
    const BasisSystem system(polytope_, equations_, lightest_, vertices);
    return {from_below(g, point_of(system)), from_above(system, g, is_level)};
  }

  const ForcePolytope& polytope_;
  const EquilibriumProblem& problem_;
  const Extrema& extrema_;
  const StageProgress& progress_;
  std::vector<int> first_;  ///< of each contact its first unknown, −1 if it is open
  double unit_;             ///< of the problem, in the scene's
  double widen_;            ///< kWiden, and room for sums over all rows or columns
  DoubledEquations equations_;
  LightestSystem lightest_;
  BasisSystem everywhere_;  ///< of the lightest vertex of every block
  UnlimitedEdges unlimited_;
  SolutionBounds bounds_;
  SensitivityBounds sensitivity_;
  Point at_lightest_;
  Enclosures enclosures_;
  std::int64_t done_ = 0;  ///< proofs that have been read
};

}  // namespace

Enclosures enclose_values(const ForcePolytope& polytope, const Extrema& extrema,
                          std::span<const SumAtOptimum> sums, const StageProgress& progress) {
  if (polytope.status != PolytopeStatus::kEmpty) return Encloser(polytope, extrema, progress).run(sums);
  Enclosures none;
  const auto count = static_cast<Eigen::Index>(polytope.problem.contacts.size());
  for (auto* table : {&none.lower, &none.upper}) table->setConstant(count, 4, kNaN);
  none.sensitivity.clear(count);
  none.proven = !polytope.doubtful;
  return none;
}

}  // namespace indet
