#include "libindet/range/central_enclosure.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "libindet/base/constants.h"
#include "libindet/base/error.h"
#include "libindet/polytope/central_polytope.h"
#include "libindet/polytope/motion_rows.h"
#include "libindet/range/barrier_ranges.h"
#include "libindet/range/functional.h"
#include "libindet/range/proof_bases.h"
#include "libindet/range/sensitivity_bounds.h"
#include "libindet/range/state_table.h"

namespace indet {
namespace {

class CentralEncloser {
 public:
  CentralEncloser(const ForcePolytope& polytope, const Extrema& extrema, const StageProgress& progress)
      : polytope_(polytope),
        problem_(polytope.problem),
        central_(*polytope.central),
        extrema_(extrema),
        progress_(progress),
        first_(polytope.problem.first_unknowns()),
        sensitivity_(polytope, extrema.value) {}

  Enclosures run(std::span<const SumAtOptimum> sums) {
    const auto count = static_cast<Eigen::Index>(problem_.contacts.size());
    for (auto* table : {&enclosures_.lower, &enclosures_.upper}) table->setConstant(count, 4, kNaN);
    enclosures_.sensitivity.clear(count);
    enclosures_.proven = !polytope_.doubtful;
    enclose_proofs();
    for (Eigen::Index i = 0; i < count; ++i) {
      for (int column = 0; column < 4; ++column) {
        if (std::isnan(enclosures_.lower(i, column)) && !std::isnan(extrema_.value(i, column)))
          enclose_determined(i, column);
      }
    }
    for (const SumAtOptimum& sum : sums) enclosures_.sums.push_back(enclose_sum(sum));
    return std::move(enclosures_);
  }

 private:
  /// A state, and its strengths on A x = b but for rounding.
  struct Point {
    SceneForces forces;
    std::vector<double> x;
  };

  static double sign_of(int column) { return column == kMaxR || column == kMaxT ? -1 : 1; }

  /// Of which the value is the least, or minus the least.
  Functional functional(Eigen::Index contact, int column) const {
    return force_component(problem_, first_, contact, column >= kMinT, sign_of(column));
  }

  std::vector<double> repaired(const InternalForces& state) const {
    const Eigen::VectorXd x = problem_.strengths_of(state);
    return central_.equations->repaired({x.data(), static_cast<std::size_t>(x.size())});
  }
  /// Through the scene's units, in which states are kept: the same bits whether one is kept or not.
  Point point_at(const SceneForces& forces) const {
    return {forces, repaired(problem_.units.internal(forces))};
  }

  /// h̃ at a basis of one block, added to `costs`.
  void add_reduced_costs(const Eigen::VectorXd& reduced, std::size_t block, const Basis& basis,
                         Eigen::VectorXd& costs) const {
    for (Eigen::Index k = 0; k < reduced.size(); ++k)
      costs[polytope_.blocks[block].edges[static_cast<std::size_t>(basis[static_cast<std::size_t>(k)])]] +=
          std::max(0.0, reduced[k]);
  }

  /// y with Aᵀ y = f − costs but for rounding.
  std::vector<double> multipliers(const Functional& f, const Eigen::VectorXd& costs) const {
    Eigen::VectorXd left = -costs;
    for (const auto& [k, coefficient] : f.on_edges) left[k] += coefficient;
    std::vector<double> y(static_cast<std::size_t>(central_.structure.rows()), 0.0);
    for (int step = 0; step < 2; ++step) {
      barrier::Objective objective;
      for (int k = 0; k < left.size(); ++k) {
        if (left[k] != 0) objective.emplace_back(k, left[k]);
      }
      const std::vector<double> more = central_.equations->nearest_multipliers(objective);
      for (std::size_t i = 0; i < y.size(); ++i) y[i] += more[i];
      const std::vector<double> along = barrier::transposed_product(central_.structure, more);
      left -= Eigen::Map<const Eigen::VectorXd>(along.data(), left.size());
    }
    return y;
  }

  void tell_progress() {
    if (progress_ && !progress_(done_++, std::ssize(extrema_.proofs))) throw Interrupted();
  }

  void enclose_proofs() {
    for_each_basis(
        polytope_, extrema_.proofs, [&](const ProofBasis& basis, std::span<const std::size_t> numbers) {
          std::optional<Point> at_vertex;
          for (const std::size_t number : numbers) {
            tell_progress();
            const OptimalBasis& proof = extrema_.proofs[number];
            const Functional f = functional(proof.contact, proof.column);
            if (f.on_edges.empty()) continue;
            Eigen::VectorXd costs = Eigen::VectorXd::Zero(problem_.unknowns());
            const Eigen::VectorXd reduced =
                -basis.vertex.multipliers(objective_on(polytope_.blocks[basis.block], f));
            add_reduced_costs(reduced, basis.block, basis.vertex.basis, costs);
            const int row = extrema_.vertex(proof.contact, proof.column);
            if (row < 0 && !at_vertex)
              at_vertex = point_at(problem_.units.scene(state_at(polytope_, basis.block, basis.vertex)));
            const Point& point = row < 0 ? *at_vertex : stored_point(row);
            const std::vector<double> y = multipliers(f, costs);
            const Sensitivity sensitivity = sensitivity_.at_vertex(
                proof.contact, proof.column, basis.block, basis.vertex, reduced, point.forces,
                [&](const Eigen::VectorXd& other) { return motion_of(multipliers(f, other)); });
            store(proof.contact, proof.column, central_.equations->enclose(f.on_edges, point.x, y),
                  sensitivity);
          }
        });
  }

  const Point& stored_point(int row) {
    if (row != stored_row_) {
      stored_ = point_at(SceneForces(extrema_.states.row(row).transpose()));
      stored_row_ = row;
    }
    return *stored_;
  }

  void enclose_determined(Eigen::Index i, int column) {
    const Functional f = functional(i, column);
    if (f.on_edges.empty())  // closed throughout F
      return store(i, column, {0, 0}, sensitivity_.closed(i, column));
    const std::vector<double> y = multipliers(f, Eigen::VectorXd::Zero(problem_.unknowns()));
    if (!lightest_) lightest_ = problem_.units.scene(problem_.state(polytope_.lightest));
    store(i, column, central_.equations->enclose_everywhere(f.on_edges, y),
          sensitivity_.everywhere(i, column, motion_of(y), *lightest_));
  }

  /// That of the maximum, one entry an equation.
  Eigen::VectorXd motion_of(const std::vector<double>& y) const {
    return -on_equations(problem_, central_.structure, y);
  }

  void store(Eigen::Index i, int column, const barrier::ValueBounds& least, const Sensitivity& sensitivity) {
    const auto [lower, upper] = value_bounds(least, sign_of(column), problem_);
    const double stored = extrema_.value(i, column);
    const double least_possible =
        column == kMinR || column == kMaxR ? 0 : -kInfinity;  // contacts do not pull
    enclosures_.lower(i, column) = std::min(stored, std::max(lower, least_possible));
    enclosures_.upper(i, column) = std::max(stored, upper);
    enclosures_.sensitivity.set(i, column, sensitivity);
  }

  SumBounds enclose_sum(const SumAtOptimum& sum) const {
    const Functional f = sum_of_forces(problem_, sum.coefficients).opposite();
    Eigen::VectorXd costs = Eigen::VectorXd::Zero(problem_.unknowns());
    for (const auto& [block, basis] : sum.bases) {
      const Vertex vertex = locate_vertex(polytope_.blocks[block].view, basis);
      add_reduced_costs(-vertex.multipliers(objective_on(polytope_.blocks[block], f)), block, basis, costs);
    }
    const std::vector<double> y = multipliers(f, costs);
    const barrier::ValueBounds least = sum.bases.empty()
                                           ? central_.equations->enclose_everywhere(f.on_edges, y)
                                           : central_.equations->enclose(f.on_edges, repaired(sum.state), y);
    const double rounding = f.rounding(central_.equations->strength_bounds());
    const auto [lower, upper] = in_scene_units({least.lower - rounding, least.upper + rounding}, problem_);
    return {-upper, -lower};
  }

  const ForcePolytope& polytope_;
  const EquilibriumProblem& problem_;
  const CentralPolytope& central_;
  const Extrema& extrema_;
  const StageProgress& progress_;
  std::int64_t done_ = 0;   ///< proofs that have been read
  std::vector<int> first_;  ///< of each contact its first unknown, −1 if it is open
  SensitivityBounds sensitivity_;
  Enclosures enclosures_;
  std::optional<Point> stored_;  ///< of row `stored_row_` of the states
  int stored_row_ = -1;
  std::optional<SceneForces> lightest_;
};

}  // namespace

Enclosures enclose_by_centre(const ForcePolytope& polytope, const Extrema& extrema,
                             std::span<const SumAtOptimum> sums, const StageProgress& progress) {
  return CentralEncloser(polytope, extrema, progress).run(sums);
}

}  // namespace indet
