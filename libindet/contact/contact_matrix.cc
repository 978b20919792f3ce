#include "libindet/contact/contact_matrix.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace indet {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

Eigen::SparseMatrix<double> assemble(int rows, int columns, const Triplets& triplets) {
  Eigen::SparseMatrix<double> matrix(rows, columns);
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  return matrix;
}

int unknowns_of(ContactMode mode) {
  switch (mode) {
    case ContactMode::kStick:
      return 2;
    case ContactMode::kSlidePlus:
    case ContactMode::kSlideMinus:
    case ContactMode::kFrictionless:
      return 1;
    case ContactMode::kOpen:
      return 0;
  }
  return 0;
}

/// Wrench on a disk in the units of its rows: force unit, and force unit × radius for the torque.
Vector3 scaled_wrench(const Packing& packing, DiskId disk, double force_unit) {
  Vector3 wrench = packing.wrench(disk) / force_unit;
  wrench.z() /= packing[disk].radius;
  return wrench;
}

/// Which equations the scene needs, numbered; −1 where an equation is left out.
class RowNumbering {
 public:
  RowNumbering(const Packing& packing, std::span<const ContactMode> modes, double force_unit)
      : numbers_(packing.disks.size(), {-1, -1, -1}) {
    std::vector<std::array<bool, 3>> needed(packing.disks.size(), {false, false, false});
    const auto touch = [&](DiskId disk, bool turns) {
      auto& components = needed[static_cast<std::size_t>(disk.value())];
      components[0] = components[1] = true;
      components[2] = components[2] || turns;
    };
    for (int i = 0; i < packing.contact_count(); ++i) {
      const ContactMode mode = modes[static_cast<std::size_t>(i)];
      const Contact& contact = packing[ContactId(i)];
      if (mode == ContactMode::kOpen) continue;
      const bool turns = mode != ContactMode::kFrictionless;
      touch(contact.a, turns);
      if (!contact.b.is_wall()) touch(contact.b.disk_id(), turns);
    }
    for (int i = 0; i < packing.disk_count(); ++i) {
      const Vector3 wrench = scaled_wrench(packing, DiskId(i), force_unit);
      for (int k = 0; k < 3; ++k) {
        const auto disk = static_cast<std::size_t>(i);
        const auto component = static_cast<std::size_t>(k);
        if (!needed[disk][component] && wrench[k] == 0) continue;
        numbers_[disk][component] = static_cast<int>(rows_.size());
        rows_.push_back({DiskId(i), k});
      }
    }
  }

  int operator()(DiskId disk, int component) const {
    return numbers_[static_cast<std::size_t>(disk.value())][static_cast<std::size_t>(component)];
  }
  const std::vector<EquilibriumRow>& rows() const { return rows_; }

 private:
  std::vector<std::array<int, 3>> numbers_;
  std::vector<EquilibriumRow> rows_;
};

/// Adds the column of the force (R, T) of one contact: c_iα [15] times (R, T), torque rows divided by the
/// radius.
void add_column(const RowNumbering& number, const Contact& contact, double R, double T, int column,
                Triplets& out) {
  const Vector2 force = R * contact.normal + T * contact.tangent();
  const auto add = [&](DiskId disk, double sign) {
    out.emplace_back(number(disk, 0), column, sign * force.x());
    out.emplace_back(number(disk, 1), column, sign * force.y());
    if (T != 0) out.emplace_back(number(disk, 2), column, T);
  };
  add(contact.a, 1);
  if (!contact.b.is_wall()) add(contact.b.disk_id(), -1);
}

}  // namespace

std::vector<ContactMode> natural_modes(const Packing& packing) {
  std::vector<ContactMode> modes;
  modes.reserve(packing.contacts.size());
  for (const Contact& contact : packing.contacts) {
    modes.push_back(contact.mu > 0 ? ContactMode::kStick : ContactMode::kFrictionless);
  }
  return modes;
}

ContactMatrix build_contact_matrix(const Packing& packing, std::span<const ContactMode> modes) {
  ContactMatrix result;
  result.force_unit = packing.internal_force_unit();
  result.modes.assign(modes.begin(), modes.end());
  const RowNumbering number(packing, modes, result.force_unit);
  result.rows = number.rows();

  Triplets matrix;
  Triplets forces;
  Triplets to_edges;
  Triplets edge_matrix;
  Triplets edge_forces;
  int column = 0;
  for (int i = 0; i < packing.contact_count(); ++i) {
    const Contact& contact = packing[ContactId(i)];
    const ContactMode mode = modes[static_cast<std::size_t>(i)];
    const double kappa = 1 / std::max(1.0, contact.mu);
    const int count = unknowns_of(mode);
    for (int k = 0; k < count; ++k) {
      int sign = 0;
      if (mode == ContactMode::kStick) sign = k == 0 ? 1 : -1;
      if (mode == ContactMode::kSlidePlus) sign = 1;
      if (mode == ContactMode::kSlideMinus) sign = -1;
      const Edge edge{ContactId(i), sign, kappa, sign * kappa * contact.mu};
      result.edges.push_back(edge);
      add_column(number, contact, edge.R, edge.T, column + k, edge_matrix);
      edge_forces.emplace_back(2 * i, column + k, edge.R);
      if (sign != 0) edge_forces.emplace_back(2 * i + 1, column + k, edge.T);
      if (mode == ContactMode::kStick) {  // unknowns R and T themselves
        forces.emplace_back(2 * i + k, column + k, 1.0);
        add_column(number, contact, k == 0 ? 1 : 0, k == 0 ? 0 : 1, column + k, matrix);
        to_edges.emplace_back(column + k, column, 0.5 / kappa);
        to_edges.emplace_back(column + k, column + 1, sign * 0.5 / (kappa * contact.mu));
      } else {
        forces.emplace_back(2 * i, column, edge.R);
        if (sign != 0) forces.emplace_back(2 * i + 1, column, edge.T);
        add_column(number, contact, edge.R, edge.T, column, matrix);
        to_edges.emplace_back(column, column, 1.0);
      }
    }
    column += count;
  }
  const int equations = static_cast<int>(result.rows.size());
  const int components = 2 * packing.contact_count();
  result.matrix = assemble(equations, column, matrix);
  result.forces = assemble(components, column, forces);
  result.to_edges = assemble(column, column, to_edges);
  result.edge_matrix = assemble(equations, column, edge_matrix);
  result.edge_forces = assemble(components, column, edge_forces);
  result.wrench.resize(equations);
  for (int row = 0; row < equations; ++row) {
    const EquilibriumRow& r = result.rows[static_cast<std::size_t>(row)];
    result.wrench[row] = scaled_wrench(packing, r.disk, result.force_unit)[r.component];
  }
  return result;
}

Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> equilibrium_residual(
    const Packing& packing, const Eigen::Ref<const Eigen::VectorXd>& forces) {
  Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> residual(packing.disk_count(), 3);
  const double unit = packing.force_unit();
  for (int i = 0; i < packing.disk_count(); ++i) {
    residual.row(i) = scaled_wrench(packing, DiskId(i), unit).transpose();
  }
  for (int i = 0; i < packing.contact_count(); ++i) {
    const Contact& contact = packing[ContactId(i)];
    const double tangential = forces[2 * i + 1] / unit;
    const Vector2 force = forces[2 * i] / unit * contact.normal + tangential * contact.tangent();
    const Vector3 on_a(force.x(), force.y(), tangential);
    residual.row(contact.a.value()) += on_a.transpose();
    if (!contact.b.is_wall()) {
      residual.row(contact.b.disk_id().value()) += Vector3(-force.x(), -force.y(), tangential).transpose();
    }
  }
  return residual;
}

CoulombCount count_coulomb(const Packing& packing, const Eigen::Ref<const Eigen::VectorXd>& forces,
                           double epsilon) {
  CoulombCount count;
  const double unit = packing.force_unit();
  for (int i = 0; i < packing.contact_count(); ++i) {
    const double R = forces[2 * i] / unit;
    const double T = std::abs(forces[2 * i + 1]) / unit;
    const double mu = packing[ContactId(i)].mu;
    const double violation = std::max(-R, T - mu * R);
    count.worst_violation = std::max(count.worst_violation, violation);
    if (violation > epsilon) ++count.violated;
    if (std::abs(R) < epsilon && T < epsilon) {
      ++count.non_transmitting;
      count.sliding += 2;
    } else if (mu > 0 && mu * R - T < epsilon) {
      ++count.sliding;
    }
  }
  return count;
}

}  // namespace indet
