#include "libindet/equilibrium/equilibrium_problem.h"

#include <algorithm>
#include <cmath>

#include "libindet/equilibrium/row_numbering.h"

namespace indet {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

Eigen::SparseMatrix<double> assemble(int rows, int columns, const Triplets& triplets) {
  Eigen::SparseMatrix<double> matrix(rows, columns);
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  return matrix;
}

int unknowns_of_mode(ContactMode mode) {
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

/// Sign of T on edge k of a contact.
int edge_sign(ContactMode mode, int k) {
  if (mode == ContactMode::kStick) return k == 0 ? 1 : -1;
  if (mode == ContactMode::kSlidePlus) return 1;
  if (mode == ContactMode::kSlideMinus) return -1;
  return 0;
}

/// Adds the column of the force (R, T) of one contact: c_iα [15] times (R, T), torque rows divided by the
/// radius.
void add_column(const RowNumbering& number, const Contact& contact, const ContactEnds& ends, double R,
                double T, int column, Triplets& out) {
  const Vector2 force = R * contact.normal + T * contact.tangent();
  const auto add = [&](DiskId disk, double sign, double arm) {
    out.emplace_back(number(disk, 0), column, sign * force.x());
    out.emplace_back(number(disk, 1), column, sign * force.y());
    if (T != 0) out.emplace_back(number(disk, 2), column, T * arm);
  };
  if (ends.a >= 0) add(contact.a, 1, ends.arm_a);
  if (ends.b >= 0) add(contact.b.disk_id(), -1, ends.arm_b);
  for (int k = 0; k < 4; ++k) {
    if (number.of_cell(k) >= 0)
      out.emplace_back(number.of_cell(k), column, -stress_part(k, force, ends.branch));
  }
  if (!contact.b.is_wall()) return;
  const int along_normal = number(contact.b.wall_id(), 0);
  const int along_tangent = number(contact.b.wall_id(), 1);
  if (along_normal >= 0 && R != 0) out.emplace_back(along_normal, column, -R);
  if (along_tangent >= 0 && T != 0) out.emplace_back(along_tangent, column, -T);
}

/// What of these loads is in an equation, in a unit of force.
double load_of(const Packing& packing, const Loads& loads, const EquilibriumRow& row, double unit) {
  if (row.body.is_wall()) return loads.on_wall(row.body.wall_id(), row.component) / unit;
  if (row.body.is_cell()) {
    const double stress = loads.stress[static_cast<std::size_t>(row.component)];
    return packing.cell.area() * (stress / unit) / packing.cell_length();
  }
  Vector3 wrench = loads.wrench(packing, row.body.disk_id()) / unit;
  wrench.z() /= packing[row.body.disk_id()].radius;
  return wrench[row.component];
}

/// The edges, and what follows from them and the modes alone: to_edges, edge_forces.
void describe_unknowns(EquilibriumProblem& problem) {
  Triplets to_edges;
  Triplets edge_forces;
  problem.edges.clear();
  int column = 0;
  for (std::size_t i = 0; i < problem.modes.size(); ++i) {
    const ContactMode mode = problem.modes[i];
    const double mu = problem.contacts[i].mu;
    const double kappa = 1 / std::max(1.0, mu);
    const int row = 2 * static_cast<int>(i);
    const int count = unknowns_of_mode(mode);
    for (int k = 0; k < count; ++k) {
      const int sign = edge_sign(mode, k);
      const Edge edge{ContactId(static_cast<int>(i)), sign, kappa, sign * kappa * mu};
      problem.edges.push_back(edge);
      edge_forces.emplace_back(row, column + k, edge.R);
      if (sign != 0) edge_forces.emplace_back(row + 1, column + k, edge.T);
      if (mode == ContactMode::kStick) {  // unknowns R and T themselves
        to_edges.emplace_back(column + k, column, 0.5 / kappa);
        to_edges.emplace_back(column + k, column + 1, sign * 0.5 / (kappa * mu));
      } else {
        to_edges.emplace_back(column, column, 1.0);
      }
    }
    column += count;
  }
  for (std::size_t k = 0; k < problem.bounds.size(); ++k) {
    const BoundRow& row = problem.bounds[k];
    if (!row.has_slack()) continue;
    problem.edges.push_back({row.bound.contact, 0, 0, 0, static_cast<int>(k)});
    to_edges.emplace_back(column, column, 1);
    ++column;
  }
  const int components = 2 * static_cast<int>(problem.modes.size());
  problem.to_edges = assemble(column, column, to_edges);
  problem.edge_forces = assemble(components, column, edge_forces);
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

int EquilibriumProblem::half_plane(const Edge& edge) const {
  if (!edge.is_slack()) return 2 * edge.contact.value() + (edge.sign < 0 ? 1 : 0);
  return bounds[static_cast<std::size_t>(edge.bound)].bound.half_plane;
}

std::vector<int> EquilibriumProblem::first_unknowns() const {
  std::vector<int> first(modes.size(), -1);
  for (int k = unknowns() - 1; k >= 0; --k)
    if (!edge(k).is_slack()) first[static_cast<std::size_t>(edge(k).contact.value())] = k;
  return first;
}

Eigen::Matrix2d EquilibriumProblem::compression_of(const Eigen::VectorXd& motion) const {
  std::array<double, 4> multipliers{};
  for (std::size_t row = 0; row < rows.size(); ++row) {
    if (rows[row].body.is_cell())
      multipliers[static_cast<std::size_t>(rows[row].component)] = motion[static_cast<Eigen::Index>(row)];
  }
  return compression(multipliers);
}

Eigen::VectorXd EquilibriumProblem::unknowns_of(const InternalForces& state) const {
  const Eigen::VectorXd& F = state.value();
  Eigen::VectorXd u(unknowns());
  for (int k = 0; k < unknowns(); ++k) {
    const Edge& edge = this->edge(k);
    if (edge.is_slack()) {
      u[k] = slack(bounds[static_cast<std::size_t>(edge.bound)].bound, F, units.internal_in_scene());
      continue;
    }
    const int contact = edge.contact.value();
    u[k] = is_stick(edge) ? F[2 * contact + (edge.sign < 0 ? 1 : 0)] : F[2 * contact] / edge.R;
  }
  return u;
}

Eigen::VectorXd EquilibriumProblem::strengths_of(const InternalForces& state) const {
  const Eigen::VectorXd& F = state.value();
  Eigen::VectorXd x(unknowns());
  for (int k = 0; k < unknowns(); ++k) {
    const Edge& edge = this->edge(k);
    if (edge.is_slack()) {
      const BoundRow& row = bounds[static_cast<std::size_t>(edge.bound)];
      x[k] = slack(row.bound, F, units.internal_in_scene());
      continue;
    }
    const int contact = edge.contact.value();
    const double R = F[2 * contact] / edge.R;
    x[k] = is_stick(edge) ? (R + F[2 * contact + 1] / edge.T) / 2 : R;
  }
  return x;
}

EquilibriumProblem pose_equilibrium(const Packing& packing, std::span<const ContactMode> modes,
                                    std::span<const Loads> changes) {
  EquilibriumProblem problem;
  problem.units = problem_units(packing);
  problem.disks = packing.disk_count();
  problem.walls = packing.wall_count();
  problem.modes.assign(modes.begin(), modes.end());
  const RowNumbering number(packing, modes, changes, problem.units);
  problem.rows = number.rows();
  const double unit = problem.units.internal_in_scene();
  const int first_bound = static_cast<int>(problem.rows.size());
  problem.bounds = rows_of(force_bounds(packing), unit);
  for (std::size_t k = 0; k < problem.bounds.size(); ++k) {
    const ForceBound& bound = problem.bounds[k].bound;
    const double size = std::abs(bound.value) + (bound.is_two_sided() ? std::abs(bound.other) : 0);
    problem.rows.push_back({.body = {}, .unit = unit, .load = size, .bound = static_cast<int>(k)});
  }
  const double cell_length = packing.stress.is_imposed() ? packing.cell_length() : 1;
  for (int i = 0; i < packing.contact_count(); ++i) {
    const Contact& contact = packing[ContactId(i)];
    ContactEnds ends{contact.normal, contact.mu};
    if (modes[static_cast<std::size_t>(i)] != ContactMode::kOpen) {
      ends.a = number(contact.a, 0);
      if (!contact.b.is_wall()) ends.b = number(contact.b.disk_id(), 0);
    }
    ends.arm_a = packing.lever_a(ContactId(i)) / packing[contact.a].radius;
    if (!contact.b.is_wall())
      ends.arm_b = packing.lever_b(ContactId(i)) / packing[contact.b.disk_id()].radius;
    if (packing.stress.is_imposed()) ends.branch = packing.branch(contact) / cell_length;
    problem.contacts.push_back(ends);
  }
  describe_unknowns(problem);

  Triplets matrix;
  Triplets edge_matrix;
  for (int column = 0; column < static_cast<int>(problem.edges.size()); ++column) {
    const Edge& edge = problem.edges[static_cast<std::size_t>(column)];
    if (edge.is_slack()) {
      add_slack(problem.bounds, first_bound, edge.bound, column, edge_matrix);
      add_slack(problem.bounds, first_bound, edge.bound, column, matrix);
      continue;
    }
    const Contact& contact = packing[edge.contact];
    const ContactEnds& ends = problem.contacts[static_cast<std::size_t>(edge.contact.value())];
    const auto add = [&](double R, double T, Triplets& out) {
      add_column(number, contact, ends, R, T, column, out);
      add_to_bounds(problem.bounds, first_bound, edge.contact, R, T, column, out);
    };
    add(edge.R, edge.T, edge_matrix);
    if (problem.is_stick(edge)) {
      const bool is_normal = edge.sign > 0;
      add(is_normal ? 1 : 0, is_normal ? 0 : 1, matrix);
    } else {
      add(edge.R, edge.T, matrix);
    }
  }
  const int equations = static_cast<int>(problem.rows.size());
  const int unknowns = static_cast<int>(problem.edges.size());
  problem.matrix = assemble(equations, unknowns, matrix);
  problem.edge_matrix = assemble(equations, unknowns, edge_matrix);
  problem.right_hand_sides.setZero(equations, 1 + std::ssize(changes));
  const Loads acting = loads_of(packing);
  for (int row = 0; row < equations; ++row) {
    const EquilibriumRow& r = problem.rows[static_cast<std::size_t>(row)];
    if (r.bound >= 0) {
      problem.right_hand_sides(row, 0) = problem.bounds[static_cast<std::size_t>(r.bound)].value;
      continue;
    }
    problem.right_hand_sides(row, 0) = -load_of(packing, acting, r, unit);
    for (std::size_t k = 0; k < changes.size(); ++k)
      problem.right_hand_sides(row, static_cast<Eigen::Index>(k) + 1) =
          -load_of(packing, changes[k], r, unit);
  }
  return problem;
}

EquilibriumProblem pose_equilibrium(const Packing& packing) {
  return pose_equilibrium(packing, natural_modes(packing));
}

EquilibriumProblem restrict_modes(const EquilibriumProblem& problem, std::span<const ContactMode> modes,
                                  std::span<const int> closed_bounds) {
  EquilibriumProblem result;
  result.units = problem.units;
  result.disks = problem.disks;
  result.walls = problem.walls;
  result.modes.assign(modes.begin(), modes.end());
  result.contacts = problem.contacts;
  result.bounds = problem.bounds;
  for (const int k : closed_bounds) result.bounds[static_cast<std::size_t>(k)].closed = true;
  describe_unknowns(result);

  // The columns that are left: of a contact that sticks both, else that of its edge.
  const std::vector<int> first = problem.first_unknowns();
  std::vector<int> slacks(problem.bounds.size(), -1);
  for (int k = 0; k < problem.unknowns(); ++k) {
    if (problem.edge(k).is_slack()) slacks[static_cast<std::size_t>(problem.edge(k).bound)] = k;
  }
  Triplets matrix;
  Triplets edge_matrix;
  std::vector<bool> needed(static_cast<std::size_t>(problem.equations()), false);
  const auto copy = [&](const Eigen::SparseMatrix<double>& from, int old, int column, Triplets& to) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(from, old); it; ++it) {
      to.emplace_back(static_cast<int>(it.row()), column, it.value());
      needed[static_cast<std::size_t>(it.row())] = true;
    }
  };
  for (int column = 0; column < static_cast<int>(result.edges.size()); ++column) {
    const Edge& edge = result.edges[static_cast<std::size_t>(column)];
    if (edge.is_slack()) {
      const int old = slacks[static_cast<std::size_t>(edge.bound)];
      copy(problem.edge_matrix, old, column, edge_matrix);
      copy(problem.matrix, old, column, matrix);
      continue;
    }
    const int before = first[static_cast<std::size_t>(edge.contact.value())];
    const bool was_stick = problem.is_stick(problem.edge(before));
    const int old = before + (was_stick && edge.sign < 0 ? 1 : 0);
    copy(problem.edge_matrix, old, column, edge_matrix);
    copy(result.is_stick(edge) ? problem.matrix : problem.edge_matrix, old, column, matrix);
  }

  std::vector<int> number(static_cast<std::size_t>(problem.equations()), -1);
  for (int row = 0; row < problem.equations(); ++row) {
    if (!needed[static_cast<std::size_t>(row)] && (problem.right_hand_sides.row(row).array() == 0).all())
      continue;
    number[static_cast<std::size_t>(row)] = static_cast<int>(result.rows.size());
    result.rows.push_back(problem.rows[static_cast<std::size_t>(row)]);
  }
  const auto numbered = [&](Triplets triplets) {
    for (auto& entry : triplets) {
      entry = {number[static_cast<std::size_t>(entry.row())], static_cast<int>(entry.col()), entry.value()};
    }
    return triplets;
  };
  const int equations = static_cast<int>(result.rows.size());
  const int unknowns = static_cast<int>(result.edges.size());
  result.matrix = assemble(equations, unknowns, numbered(matrix));
  result.edge_matrix = assemble(equations, unknowns, numbered(edge_matrix));
  result.right_hand_sides.resize(equations, problem.right_hand_sides.cols());
  for (std::size_t row = 0; row < number.size(); ++row) {
    if (number[row] >= 0)
      result.right_hand_sides.row(number[row]) = problem.right_hand_sides.row(static_cast<Eigen::Index>(row));
  }
  for (std::size_t i = 0; i < result.contacts.size(); ++i) {
    const bool is_open = result.modes[i] == ContactMode::kOpen;
    for (int* row : {&result.contacts[i].a, &result.contacts[i].b}) {
      if (*row >= 0) *row = is_open ? -1 : number[static_cast<std::size_t>(*row)];
    }
  }
  return result;
}

}  // namespace indet
