#include "libindet/polytope/central_polytope.h"

#include <algorithm>
#include <utility>

#include "libindet/exact/certificate.h"
#include "libindet/polytope/motion_rows.h"
#include "libindet/polytope/sparse_decision.h"
#include "libindet/polytope/unbounded_polytope.h"

namespace indet {
namespace {

std::shared_ptr<const NullSpace> without_kernel(const RankDecision& rank) {
  auto null_space = std::make_shared<NullSpace>();
  static_cast<RankDecision&>(*null_space) = rank;
  return null_space;
}

void set_centre(std::shared_ptr<const CentralPolytope> central, ForcePolytope& polytope) {
  const std::vector<double>& x = central->centre.x;
  polytope.interior = Eigen::Map<const Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
  polytope.interior_slack = std::min(1.0, polytope.interior.minCoeff());
  polytope.central = std::move(central);
}

/// What decide_sparsely proves.
std::optional<ForcePolytope> find_decided_polytope(const Packing& packing, ForcePolytope polytope) {
  SparseDecision decision = decide_sparsely(packing);
  if (!decision.decided || decision.rank_ambiguous || decision.proof == SparseDecision::Proof::kNone)
    return {};
  // The rank of what is left where edges are closed was decided on the way, and is not kept.
  if (!decision.steps.empty()) polytope.null_space.reset();
  polytope.problem = std::move(decision.problem);
  polytope.status = decision.status;
  polytope.dim = decision.dim;
  polytope.interior = decision.interior;
  polytope.ray = decision.ray;
  polytope.unbounded = std::move(decision.unbounded);
  if (decision.status == PolytopeStatus::kEmpty)
    set_motion(packing, exact::ContactProblem(packing), decision.proven_motion, polytope);
  if (decision.status != PolytopeStatus::kBounded && decision.status != PolytopeStatus::kPoint)
    return polytope;
  auto central = std::make_shared<const CentralPolytope>(polytope.problem, decision.independent_rows);
  if (!central->is_proven()) return {};
  set_centre(std::move(central), polytope);
  return polytope;
}

std::optional<ForcePolytope> find_without_parts(const Packing& packing) {
  ForcePolytope polytope;
  polytope.natural = pose_equilibrium(packing);
  const RankDecision rank = decide_rank(polytope.natural.matrix);
  if (rank.ambiguous) return {};
  polytope.natural_null_space = polytope.null_space = without_kernel(rank);
  // Most packings: the centre by itself proves all there is to decide, but that rows follow from others.
  if (rank.rank > 0) {
    auto central = std::make_shared<const CentralPolytope>(polytope.natural, rank.independent_rows);
    const bool is_plain = rank.rank == polytope.natural.equations();
    if (central->is_proven() &&
        (is_plain || exact::proves_structure(exact::ContactProblem(packing), {}, rank.rank, kExactRows))) {
      polytope.problem = polytope.natural;
      polytope.dim = rank.nullity;
      polytope.status = polytope.dim > 0 ? PolytopeStatus::kBounded : PolytopeStatus::kPoint;
      set_centre(std::move(central), polytope);
      return polytope;
    }
  }
  return find_decided_polytope(packing, std::move(polytope));
}

barrier::IndependentParts find_parts(const ForcePolytope& polytope) {
  if (polytope.dim <= 0) return {0, ""};
  if (polytope.central)
    return find_independent_parts(polytope.central->structure, polytope.central->centre.x);
  if (!polytope.unbounded)
    return {-1, "forces are unbounded, and bodies that they press together can still move"};
  // The limit would join all that it limits.
  const barrier::BlockStructure unlimited(polytope.problem, polytope.unbounded->rows);
  const std::vector<double>& x = polytope.unbounded->within->centre.x;
  return find_independent_parts(unlimited, std::span(x).first(static_cast<std::size_t>(unlimited.columns())));
}

}  // namespace

CentralPolytope::CentralPolytope(const EquilibriumProblem& problem, std::span<const int> independent,
                                 barrier::Limit limit)
    : rows(independent.begin(), independent.end()), structure(problem, rows, std::move(limit)) {
  barrier::BlockCholesky cholesky(structure);
  centre = barrier::find_analytic_centre(structure, cholesky);
  if (centre.found) equations.emplace(problem, structure, centre);
}

std::optional<ForcePolytope> find_sparse_polytope(const Packing& packing) {
  std::optional<ForcePolytope> polytope = find_without_parts(packing);
  if (polytope) polytope->parts = find_parts(*polytope);
  return polytope;
}

bool add_centre(ForcePolytope& polytope) {
  if (polytope.status != PolytopeStatus::kBounded) return false;
  auto central =
      std::make_shared<const CentralPolytope>(polytope.problem, polytope.null_space->independent_rows);
  if (!central->is_proven()) return false;
  polytope.central = std::move(central);
  return true;
}

}  // namespace indet
