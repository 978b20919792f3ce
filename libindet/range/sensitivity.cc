#include "libindet/range/sensitivity.h"

#include <cmath>

namespace indet {

double sensitivity_to_normals(const EquilibriumProblem& problem, const Eigen::VectorXd& motion,
                              const SceneForces& forces) {
  const Eigen::Matrix2d compression = problem.compression_of(motion);
  double sum = 0;
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    const ContactEnds& contact = problem.contacts[i];
    Vector2 relative = -compression * contact.branch;
    if (contact.a >= 0) relative += motion.segment<2>(contact.a);
    if (contact.b >= 0) relative -= motion.segment<2>(contact.b);
    const double R = forces.value()[2 * static_cast<Eigen::Index>(i)];
    const double T = forces.value()[2 * static_cast<Eigen::Index>(i) + 1];
    sum += std::abs(relative.dot(T * contact.normal - R * contact.tangent()));
  }
  return sum;
}

}  // namespace indet
