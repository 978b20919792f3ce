#include "libindet/range/central_widths.h"

#include "libindet/barrier/dikin_widths.h"
#include "libindet/polytope/central_polytope.h"
#include "libindet/polytope/force_polytope.h"

namespace indet {

CentralWidths central_widths(const ForcePolytope& polytope) {
  return central_widths(polytope.problem, *polytope.central);
}

CentralWidths central_widths(const EquilibriumProblem& problem, const CentralPolytope& central) {
  const auto count = static_cast<Eigen::Index>(problem.contacts.size());
  barrier::BlockCholesky cholesky(central.structure);
  const barrier::DikinWidths widths =
      barrier::dikin_widths(problem, central.structure, central.centre, cholesky);
  const std::vector<double>& x = central.centre.x;
  const Eigen::Map<const Eigen::VectorXd> strengths(x.data(),
                                                    problem.unknowns());  // a limit has a slack more
  const Eigen::VectorXd forces = problem.units.scene(problem.state(strengths)).value();
  CentralWidths result;
  result.centre.resize(count, 2);
  result.width.resize(count, 2);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    result.centre.row(i) << forces[2 * i], forces[2 * i + 1];
    result.width.row(i) << widths.R[at], widths.T[at];
  }
  result.width *= problem.units.internal_in_scene();
  return result;
}

}  // namespace indet
