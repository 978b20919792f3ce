#include "libindet/limit/standing.h"

#include <memory>

#include "libindet/equilibrium/equilibrium_problem.h"
#include "libindet/limit/exact_basis.h"
#include "libindet/limit/limit_program.h"

namespace indet {

Standing find_standing(const Packing& packing, const LimitOptions& options) {
  const EquilibriumProblem problem = pose_equilibrium(packing);
  const exact::ContactProblem exact(packing);
  const LimitProgram::Answer answer = LimitProgram(problem).find(0);
  const std::shared_ptr<const exact::ContactBasis> start =
      exact::ContactBasis::create(exact, exact.choose_basis(basis_preferences(exact, problem, answer.basic)));
  Standing result;
  if (!start) return result;
  const exact::Optimum found = exact::find_solution(exact, start, options.most_pivots);
  result.verdict = found.verdict;
  if (result.stands()) {
    result.forces = forces_of(*found.basis, packing.contact_count());
  } else if (found.verdict == exact::Verdict::kEmpty) {
    result.motion = exact::on_bodies(packing, exact, found.basis->falling_motion(found.edge));
  } else if (found.verdict == exact::Verdict::kInconsistent) {
    result.motion = exact::on_bodies(packing, exact, *found.basis->contradiction());
  }
  return result;
}

}  // namespace indet
