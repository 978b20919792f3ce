#include "libindet/range/paper_start.h"

#include "libindet/base/tolerances.h"
#include "libindet/lp/purification.h"
#include "libindet/pivoting/interior_start.h"
#include "libindet/polytope/interior.h"

namespace indet {

Basis first_extremal_point(const SceneForces& simulated, const ForcePolytope& polytope,
                           const PolytopeBlock& block, const LpOptions& options, PaperWork& work) {
  const EquilibriumProblem& problem = polytope.problem;
  const Eigen::VectorXd strengths = problem.strengths_of(problem.units.internal(simulated))(block.edges);
  const InteriorStart start = leave_sliding_contacts(block.view, strengths, tolerance::kActive);
  ++work.starts[static_cast<std::size_t>(start.end)];
  work.sliding_left += start.left;
  const Eigen::VectorXd interior =
      start.end == InteriorEnd::kFound ? start.z : find_interior_point(block.view, options).z;
  return purify_to_vertex(block.view, interior, Eigen::VectorXd::Zero(block.view.dim()));
}

}  // namespace indet
