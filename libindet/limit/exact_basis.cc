#include "libindet/limit/exact_basis.h"

#include "libindet/exact/optimum.h"

namespace indet {

std::vector<double> basis_preferences(const exact::ContactProblem& exact, const EquilibriumProblem& problem,
                                      const std::vector<bool>& basic) {
  std::vector<double> preferences(static_cast<std::size_t>(exact.edges()), 0);
  for (int k = 0; k < problem.unknowns(); ++k) {
    if (basic[static_cast<std::size_t>(k)])
      preferences[static_cast<std::size_t>(problem.half_plane(problem.edge(k)))] = 1;
  }
  return preferences;
}

std::shared_ptr<const exact::ContactBasis> basis_of(const exact::ContactProblem& exact,
                                                    const EquilibriumProblem& problem,
                                                    const LimitProgram::Answer& answer) {
  std::vector<double> wanted = basis_preferences(exact, problem, answer.basic);
  for (const bool falls : {answer.lambda < 0, !(answer.lambda < 0)}) {
    const int lambda = falls ? exact.fall() : exact.rise();
    wanted[static_cast<std::size_t>(exact.rise())] = wanted[static_cast<std::size_t>(exact.fall())] = 0;
    if (answer.lambda_is_basic) wanted[static_cast<std::size_t>(lambda)] = 2;
    std::shared_ptr<const exact::ContactBasis> basis =
        exact::ContactBasis::create(exact, exact.choose_basis(wanted));
    if (!basis || !answer.lambda_is_basic || basis->sign_of_strength(lambda) >= 0) return basis;
  }
  return nullptr;
}

SceneForces forces_of(const exact::ContactBasis& basis, int contacts) {
  const std::vector<double> forces = basis.nearest_forces();
  return SceneForces(Eigen::Map<const Eigen::VectorXd>(forces.data(), 2 * contacts));
}

ClosedContacts closed_contacts(const exact::ContactProblem& problem, const exact::ContactBasis& basis) {
  const int contacts = problem.contacts();
  ClosedContacts closed;
  for (int contact = 0; contact < contacts; ++contact) {
    const int open = (basis.sign_of_strength(2 * contact) != 0 ? 1 : 0) +
                     (basis.sign_of_strength(2 * contact + 1) != 0 ? 1 : 0);
    const bool has_friction = problem.mu(contact) > 0;
    closed.contacts += open == 0 ? 1 : 0;
    closed.edges += open == 0 ? 2 : has_friction ? 2 - open : 0;
  }
  return closed;
}

}  // namespace indet
