#include "libindet/equilibrium/contact_state.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace indet {

Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> equilibrium_residual(const Packing& packing,
                                                                               const SceneForces& forces) {
  Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> residual(packing.disk_count(), 3);
  const double unit = packing.force_unit();
  for (int i = 0; i < packing.disk_count(); ++i) {
    Vector3 wrench = packing.wrench(DiskId(i)) / unit;
    wrench.z() /= packing[DiskId(i)].radius;
    residual.row(i) = wrench.transpose();
  }
  for (int i = 0; i < packing.contact_count(); ++i) {
    const Contact& contact = packing[ContactId(i)];
    const double tangential = forces.value()[2 * i + 1] / unit;
    const Vector2 force = forces.value()[2 * i] / unit * contact.normal + tangential * contact.tangent();
    const auto add = [&](DiskId disk, double side, double lever) {
      if (!packing.has_equations(disk)) return;
      const double torque = tangential * (lever / packing[disk].radius);
      residual.row(disk.value()) += Vector3(side * force.x(), side * force.y(), torque).transpose();
    };
    add(contact.a, 1, packing.lever_a(ContactId(i)));
    if (!contact.b.is_wall()) add(contact.b.disk_id(), -1, packing.lever_b(ContactId(i)));
  }
  return residual;
}

Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor> wall_residual(const Packing& packing,
                                                                        const SceneForces& forces) {
  Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor> residual(packing.wall_count(), 2);
  const double unit = packing.force_unit();
  for (int w = 0; w < packing.wall_count(); ++w)
    residual.row(w) << packing[WallId(w)].load_n / unit, packing[WallId(w)].load_t / unit;
  for (int i = 0; i < packing.contact_count(); ++i) {
    const Body wall = packing[ContactId(i)].b;
    if (!wall.is_wall()) continue;
    residual.row(wall.wall_id().value()) -= forces.value().segment<2>(2 * i).transpose() / unit;
  }
  return residual.unaryExpr([](double value) { return std::isnan(value) ? 0 : value; });
}

Eigen::Matrix2d contact_stress(const Packing& packing, const SceneForces& forces) {
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  for (int i = 0; i < packing.contact_count(); ++i) {
    const Contact& contact = packing[ContactId(i)];
    const Vector2 force =
        forces.value()[2 * i] * contact.normal + forces.value()[2 * i + 1] * contact.tangent();
    sum += force * packing.branch(contact).transpose();
  }
  return sum / packing.cell.area();
}

Eigen::Vector4d stress_residual(const Packing& packing, const SceneForces& forces) {
  if (!packing.stress.is_imposed()) return Eigen::Vector4d::Zero();
  const Eigen::Matrix2d found = contact_stress(packing, forces);
  const std::array<double, 4> components = {found(0, 0), found(1, 1), found(0, 1), found.trace() / 2};
  const auto imposed = packing.stress.components();
  const double size = packing.cell.area() / (packing.cell_length() * packing.force_unit());
  Eigen::Vector4d residual;
  for (std::size_t k = 0; k < 4; ++k)
    residual[static_cast<Eigen::Index>(k)] = std::isnan(imposed[k]) ? 0 : size * (imposed[k] - components[k]);
  return residual;
}

double largest_imbalance(const Packing& packing, const SceneForces& forces) {
  double largest = 0;
  if (packing.disk_count() > 0) largest = equilibrium_residual(packing, forces).cwiseAbs().maxCoeff();
  if (packing.has_loaded_walls())
    largest = std::max(largest, wall_residual(packing, forces).cwiseAbs().maxCoeff());
  if (packing.stress.is_imposed())
    largest = std::max(largest, stress_residual(packing, forces).cwiseAbs().maxCoeff());
  return largest;
}

double worst_bound_violation(const std::vector<ForceBound>& bounds, const SceneForces& forces) {
  double worst = 0;
  for (const ForceBound& bound : bounds) worst = std::max(worst, -slack(bound, forces.value()));
  return worst;
}

CoulombCount count_coulomb(const Packing& packing, const SceneForces& forces, double epsilon) {
  CoulombCount count;
  const ForceUnits units = packing.force_units();
  const InternalForces internal = units.internal(forces);
  double worst = 0;
  for (int i = 0; i < packing.contact_count(); ++i) {
    const double R = internal.value()[2 * i];
    const double T = std::abs(internal.value()[2 * i + 1]);
    const double mu = packing[ContactId(i)].mu;
    const double violation = std::max(-R, T - mu * R);
    worst = std::max(worst, violation);
    if (violation > epsilon) ++count.violated;
    if (std::abs(R) < epsilon && T < epsilon) {
      ++count.non_transmitting;
      count.sliding += 2;
    } else if (mu > 0 && mu * R - T < epsilon) {
      ++count.sliding;
    }
  }
  count.worst_violation = units.weights(InternalForce(worst)).value();
  return count;
}

}  // namespace indet
