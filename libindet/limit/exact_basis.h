#pragma once

#include <memory>
#include <vector>

#include "libindet/equilibrium/equilibrium_problem.h"
#include "libindet/exact/contact_basis.h"
#include "libindet/limit/limit_program.h"
#include "libindet/packing/force.h"

namespace indet {

/// 1 for each edge of the exact problem that is basic in a basis of double precision (one of each edge of
/// `problem`), else 0: what exact::ContactProblem::choose_basis takes.
std::vector<double> basis_preferences(const exact::ContactProblem& exact, const EquilibriumProblem& problem,
                                      const std::vector<bool>& basic);

/// The basis where a linear program ended, with λ as the part that has its sign; null if it is singular.
/// Precondition: the exact problem has λ.
std::shared_ptr<const exact::ContactBasis> basis_of(const exact::ContactProblem& exact,
                                                    const EquilibriumProblem& problem,
                                                    const LimitProgram::Answer& answer);

/// R and T of each contact, rounded.
SceneForces forces_of(const exact::ContactBasis& basis, int contacts);

/// M_s, how many edges of contacts with friction have no strength, and a contact without force counts twice;
/// and how many contacts have no force (CoulombCount).
struct ClosedContacts {
  int edges = 0;
  int contacts = 0;
};
ClosedContacts closed_contacts(const exact::ContactProblem& problem, const exact::ContactBasis& basis);

}  // namespace indet
