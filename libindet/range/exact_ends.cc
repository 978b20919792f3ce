#include "libindet/range/exact_ends.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "libindet/base/constants.h"
#include "libindet/base/tolerances.h"
#include "libindet/exact/optimum.h"
#include "libindet/range/promise.h"
#include "libindet/range/state_table.h"

namespace indet {
namespace {

/// Work is counted in squares of the number of equations, summed over solves: `verify
/// --exact` took 0.12 s an objective with 285 of them, 8 ms with 75. This much is about a second.
constexpr double kMostWork = 1e6;
constexpr double kLeastSolve = 1e3;
constexpr int kMostPivots = 20;

using Bases = std::vector<std::pair<std::size_t, Basis>>;

/// The exact basis next to a state that has blocks at these bases, and the others at their lightest vertex.
std::shared_ptr<const exact::ContactBasis> basis_of(const Packing& packing, const ForcePolytope& polytope,
                                                    const InternalForces& state, const Bases& bases) {
  const SceneForces forces = polytope.problem.units.scene(state);
  const Eigen::VectorXd& F = forces.value();
  std::vector<double> preference =
      exact::edge_strengths(packing, std::span(F.data(), static_cast<std::size_t>(F.size())));
  for (std::size_t b = 0; b < polytope.blocks.size(); ++b) {
    const PolytopeBlock& block = polytope.blocks[b];
    const auto own =
        std::find_if(bases.begin(), bases.end(), [&](const auto& basis) { return basis.first == b; });
    for (const int k : own != bases.end() ? own->second : block.lightest) {
      const Edge& edge = polytope.problem.edge(block.edges[static_cast<std::size_t>(k)]);
      preference[static_cast<std::size_t>(polytope.problem.half_plane(edge))] = -kInfinity;
    }
  }
  return exact::ContactBasis::create(*polytope.exact, polytope.exact->choose_basis(preference));
}

}  // namespace

void settle_exactly(const Packing& packing, const ForcePolytope& polytope, const Extrema& extrema,
                    std::span<const SumAtOptimum> sums, Enclosures& enclosures) {
  const Eigen::VectorXd loads = loads_at_contacts(packing);
  Table4<int> proofs = Table4<int>::Constant(extrema.value.rows(), 4, -1);
  for (std::size_t k = 0; k < extrema.proofs.size(); ++k)
    proofs(extrema.proofs[k].contact, extrema.proofs[k].column) = static_cast<int>(k);
  const double solve = kLeastSolve + std::pow(static_cast<double>(polytope.exact->rows()), 2);
  double work = 0;
  const auto settle = [&](const InternalForces& state, const Bases& bases, const exact::Goal& goal) {
    std::optional<mpq_class> value;
    if (const auto start = basis_of(packing, polytope, state, bases)) {
      const int pivots = std::clamp(static_cast<int>((kMostWork - work) / solve), 0, kMostPivots);
      const exact::Optimum found = exact::maximise(*polytope.exact, start, goal, pivots);
      work += found.pivots * solve;
      if (found.verdict == exact::Verdict::kOptimal) value = found.value;
    }
    return value;
  };
  for (Eigen::Index i = 0; i < extrema.value.rows(); ++i) {
    for (int column = 0; column < 4; ++column) {
      const double stored = extrema.value(i, column);
      double& lower = enclosures.lower(i, column);
      double& upper = enclosures.upper(i, column);
      const bool is_optimal = extrema.claim(i, column) == Outcome::kOptimal &&
                              extrema.dual_residual(i, column) <= tolerance::kReducedCost;
      if (!is_optimal || !std::isfinite(stored)) continue;
      if (upper - lower <= promised_width(stored, loads[i])) continue;
      if ((work += solve) > kMostWork) return;
      InternalForces state = polytope.problem.state(polytope.lightest);
      Bases bases;
      if (proofs(i, column) >= 0) {
        const OptimalBasis& proof = extrema.proofs[static_cast<std::size_t>(proofs(i, column))];
        state =
            state_at(polytope, proof.block, locate_vertex(polytope.blocks[proof.block].view, proof.basis));
        bases.emplace_back(proof.block, proof.basis);
      }
      const bool is_maximum = column == kMaxR || column == kMaxT;
      const int component = static_cast<int>(2 * i) + (column >= kMinT ? 1 : 0);
      const auto value = settle(state, bases, {component, is_maximum ? 1 : -1});
      if (!value) continue;
      const exact::Enclosure bounds = exact::enclose(*value);
      lower = std::min(stored, bounds.lower);
      upper = std::max(stored, bounds.upper);
    }
  }
  for (std::size_t k = 0; k < enclosures.sums.size(); ++k) {
    SumBounds& sum = enclosures.sums[k];
    if (std::isfinite(sum.upper - sum.lower)) continue;
    if ((work += solve) > kMostWork) return;
    std::vector<std::pair<int, double>> terms;
    for (Eigen::Index c = 0; c < sums[k].coefficients.size(); ++c) {
      if (sums[k].coefficients[c] != 0) terms.emplace_back(static_cast<int>(c), sums[k].coefficients[c]);
    }
    const auto value = settle(sums[k].state, sums[k].bases, {std::move(terms), 1});
    if (!value) continue;
    const exact::Enclosure bounds = exact::enclose(*value);
    sum = {bounds.lower, bounds.upper};
  }
}

}  // namespace indet
