#include "libindet/polytope/central_polytope.h"

#include <algorithm>
#include <utility>

#include "libindet/exact/certificate.h"

namespace indet {

std::optional<ForcePolytope> find_central_polytope(const Packing& packing) {
  ForcePolytope polytope;
  polytope.natural = pose_equilibrium(packing);
  const RankDecision rank = decide_rank(polytope.natural.matrix);
  if (rank.ambiguous || rank.nullity == 0 || rank.rank == 0) return {};
  auto central = std::make_shared<const CentralPolytope>(polytope.natural, rank.independent_rows);
  if (!central->is_proven()) return {};
  if (rank.rank < polytope.natural.equations()) {
    // The rows that were kept are independent; that the others follow from them is for exact arithmetic to
    // say.
    polytope.exact = std::make_shared<exact::ContactProblem>(packing);
    if (!exact::proves_structure(*polytope.exact, {}, rank.rank)) return {};
  }
  polytope.problem = polytope.natural;
  polytope.natural_null_space = polytope.null_space =
      std::make_shared<NullSpace>(NullSpace{rank, {}, {}, {}, {}, {}});
  polytope.status = PolytopeStatus::kBounded;
  polytope.dim = rank.nullity;
  const std::vector<double>& x = central->centre.x;
  polytope.interior = Eigen::Map<const Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
  polytope.interior_slack = std::min(1.0, polytope.interior.minCoeff());
  polytope.central = std::move(central);
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
