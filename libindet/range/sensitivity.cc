#include "libindet/range/sensitivity.h"

#include <cmath>

#include "libindet/base/constants.h"

namespace indet {

void Sensitivities::clear(Eigen::Index contacts) {
  value.setConstant(contacts, 4, kNaN);
  claim.setConstant(contacts, 4, static_cast<std::uint8_t>(SensitivityClaim::kNone));
}

void Sensitivities::set(Eigen::Index contact, int column, const Sensitivity& sensitivity) {
  value(contact, column) = sensitivity.value;
  claim(contact, column) = static_cast<std::uint8_t>(sensitivity.claim);
}

Vector2 relative_velocity(const EquilibriumProblem& problem, const Eigen::VectorXd& motion,
                          const Eigen::Matrix2d& compression, std::size_t contact) {
  const ContactEnds& ends = problem.contacts[contact];
  Vector2 relative = -compression * ends.branch;
  if (ends.a >= 0) relative += motion.segment<2>(ends.a);
  if (ends.b >= 0) relative -= motion.segment<2>(ends.b);
  return relative;
}

double sensitivity_to_normals(const EquilibriumProblem& problem, const Eigen::VectorXd& motion,
                              const SceneForces& forces) {
  const Eigen::Matrix2d compression = problem.compression_of(motion);
  double sum = 0;
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    const ContactEnds& contact = problem.contacts[i];
    const double R = forces.value()[2 * static_cast<Eigen::Index>(i)];
    const double T = forces.value()[2 * static_cast<Eigen::Index>(i) + 1];
    sum += std::abs(
        relative_velocity(problem, motion, compression, i).dot(T * contact.normal - R * contact.tangent()));
  }
  return sum;
}

}  // namespace indet
