#include "libindet/range/exact_ends.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include "libindet/base/constants.h"
#include "libindet/exact/optimum.h"
#include "libindet/range/promise.h"
#include "libindet/range/state_table.h"

namespace indet {
namespace {

/// Cubes of the number of equations, summed over solves: some seconds.
constexpr double kMostWork = 1e9;
constexpr int kMostPivots = 20;

/// The exact basis next to the vertex of `proof`, or next to the lightest state where there is none.
std::shared_ptr<const exact::ContactBasis> basis_of(const Packing& packing, const ForcePolytope& polytope,
                                                    const OptimalBasis* proof) {
  const InternalForces state =
      proof == nullptr ? polytope.problem.state(polytope.lightest)
                       : state_at(polytope, proof->block,
                                  compute_vertex(polytope.blocks[proof->block].view, proof->basis));
  const SceneForces forces = polytope.problem.units.scene(state);
  const Eigen::VectorXd& F = forces.value();
  std::vector<double> preference =
      exact::edge_strengths(packing, std::span(F.data(), static_cast<std::size_t>(F.size())));
  for (std::size_t b = 0; b < polytope.blocks.size(); ++b) {
    const PolytopeBlock& block = polytope.blocks[b];
    for (const int k : proof != nullptr && proof->block == b ? proof->basis : block.lightest) {
      const Edge& edge = polytope.problem.edge(block.edges[static_cast<std::size_t>(k)]);
      preference[static_cast<std::size_t>(polytope.problem.half_plane(edge))] = -kInfinity;
    }
  }
  return exact::ContactBasis::create(*polytope.exact, polytope.exact->choose_basis(preference));
}

}  // namespace

void settle_exactly(const Packing& packing, const ForcePolytope& polytope, const Extrema& extrema,
                    Enclosures& enclosures) {
  const Eigen::VectorXd loads = loads_at_contacts(packing);
  Table4<int> proofs = Table4<int>::Constant(extrema.value.rows(), 4, -1);
  for (std::size_t k = 0; k < extrema.proofs.size(); ++k)
    proofs(extrema.proofs[k].contact, extrema.proofs[k].column) = static_cast<int>(k);
  double work = 0;
  for (Eigen::Index i = 0; i < extrema.value.rows(); ++i) {
    for (int column = 0; column < 4; ++column) {
      const double stored = extrema.value(i, column);
      double& lower = enclosures.lower(i, column);
      double& upper = enclosures.upper(i, column);
      if (!std::isfinite(stored) || upper - lower <= promised_width(stored, loads[i])) continue;
      const auto start = [&] {
        work += std::pow(static_cast<double>(polytope.exact->rows()), 3);
        const int proof = proofs(i, column);
        return work > kMostWork
                   ? nullptr
                   : basis_of(packing, polytope,
                              proof < 0 ? nullptr : &extrema.proofs[static_cast<std::size_t>(proof)]);
      }();
      if (!start) continue;
      const bool is_maximum = column == kMaxR || column == kMaxT;
      const exact::Goal goal(static_cast<int>(2 * i) + (column >= kMinT ? 1 : 0), is_maximum ? 1 : -1);
      const exact::Optimum found = exact::maximise(*polytope.exact, start, goal, kMostPivots);
      work += found.pivots * std::pow(static_cast<double>(polytope.exact->rows()), 3);
      if (found.verdict != exact::Verdict::kOptimal) continue;
      const exact::Enclosure bounds = exact::enclose(found.value);
      lower = std::min(stored, bounds.lower);
      upper = std::max(stored, bounds.upper);
    }
  }
}

}  // namespace indet
