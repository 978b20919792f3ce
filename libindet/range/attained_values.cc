#include "libindet/range/attained_values.h"

#include <algorithm>

#include "libindet/base/constants.h"
#include "libindet/equilibrium/contact_state.h"

namespace indet {

StateResidual StateChecker::operator()(const SceneForces& forces) const {
  const double largest = forces.value().size() > 0 ? forces.value().lpNorm<Eigen::Infinity>() : 0.0;
  const double scale = std::max(packing_.internal_force_unit() / unit_, largest / unit_);
  const double imbalance = largest_imbalance(packing_, forces);
  const double primal = std::max({imbalance, count_coulomb(packing_, forces, 0).worst_violation,
                                  worst_bound_violation(bounds_, forces) / unit_});
  return {primal / scale, imbalance};
}

void AttainedValues::clear(Eigen::Index contacts) {
  for (auto* table : {&value, &primal_residual}) table->setConstant(contacts, 4, kNaN);
  imbalance = 0;
}

void AttainedValues::note(Eigen::Index contact, int column, const SceneForces& forces,
                          const StateResidual& residual) {
  value(contact, column) = forces.value()[2 * contact + (column >= kMinT ? 1 : 0)];
  primal_residual(contact, column) = residual.primal;
  imbalance = std::max(imbalance, residual.imbalance);
}

void note_states(const Rows<double>& states, const Table4<std::int32_t>& vertex, const StateChecker& check,
                 AttainedValues& attained) {
  std::vector<StateResidual> residuals;
  for (Eigen::Index row = 0; row < states.rows(); ++row)
    residuals.push_back(check(SceneForces(states.row(row).transpose())));
  for (Eigen::Index i = 0; i < vertex.rows(); ++i) {
    for (int column = 0; column < 4; ++column) {
      const std::int32_t row = vertex(i, column);
      if (row >= 0)
        attained.note(i, column, SceneForces(states.row(row).transpose()),
                      residuals[static_cast<std::size_t>(row)]);
    }
  }
}

}  // namespace indet
