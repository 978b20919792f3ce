#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "libindet/barrier/analytic_centre.h"
#include "libindet/barrier/block_cholesky.h"
#include "libindet/barrier/block_structure.h"
#include "libindet/barrier/lock_step.h"
#include "libindet/equilibrium/equilibrium_problem.h"
#include "libindet/nullspace/sparse_qr.h"
#include "libindet/range/force_ranges.h"
#include "tests/support/body_variants.h"
#include "tests/support/periodic_lattice.h"
#include "tests/support/zoo.h"

namespace indet::test {

inline std::vector<int> independent_rows(const EquilibriumProblem& problem) {
  if (problem.equations() == 0 || problem.unknowns() == 0) return {};
  return SparseQr(problem.matrix.transpose(), 1e-10).independent_columns();
}

/// The set {A x = b, x ≥ 0} of a packing, on independent rows.
struct StrengthSet {
  explicit StrengthSet(const Packing& packing)
      : problem(pose_equilibrium(packing)),
        rows(independent_rows(problem)),
        structure(problem, rows),
        cholesky(structure) {}
  StrengthSet(const StrengthSet&) = delete;
  StrengthSet& operator=(const StrengthSet&) = delete;

  /// A, rows in the order of the structure.
  Eigen::MatrixXd matrix() const {
    const Eigen::MatrixXd all = problem.edge_matrix;
    Eigen::MatrixXd result(structure.rows(), structure.columns());
    for (int i = 0; i < structure.rows(); ++i)
      result.row(i) = all.row(structure.equation_of_place()[static_cast<std::size_t>(i)]);
    return result;
  }
  /// What has to be minimised for one of the extrema of a contact: R, −R, T or −T.
  barrier::Objective objective(int contact, int column) const {
    const double sign = column == kMinR || column == kMinT ? 1 : -1;
    barrier::Objective terms;
    for (int k = 0; k < problem.unknowns(); ++k) {
      const Edge& edge = problem.edge(k);
      if (edge.is_slack() || edge.contact.value() != contact) continue;
      const double weight = column < kMinT ? edge.R : edge.T;
      if (weight != 0) terms.emplace_back(k, sign * weight);
    }
    return terms;
  }
  /// All of them: that of contact i and a column comes at 4 i + column.
  std::vector<barrier::Objective> objectives() const {
    std::vector<barrier::Objective> all;
    for (int i = 0; i < static_cast<int>(problem.modes.size()); ++i) {
      for (int column = 0; column < 4; ++column) all.push_back(objective(i, column));
    }
    return all;
  }

  EquilibriumProblem problem;
  std::vector<int> rows;
  barrier::BlockStructure structure;
  barrier::BlockCholesky cholesky;
};

inline Eigen::VectorXd vector(std::span<const double> values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

struct Named {
  std::string name;
  Packing packing;
};

/// A pile that stands, some of whose forces are bounded from both sides, from one, and to one value.
inline Packing bounded_pile() {
  Packing packing = zoo::column(5, 0.3, 0.6);
  packing.contacts[0].R_lo = 1;
  packing.contacts[0].R_hi = 7;
  packing.contacts[0].T_lo = -2;
  packing.contacts[0].T_hi = 2.5;
  packing.contacts[3].R_hi = 6;
  packing.contacts[6].T_lo = -0.75;
  return packing;
}

/// Bounded sets with interior, one of each kind of equations and unknowns.
inline std::vector<Named> packings() {
  return {
      {"groove", zoo::wedge(0.5, 0.4)},
      {"column", zoo::column(6, 0.4, 0.3)},
      {"two grooves", zoo::two_wedges(0.3, 0.3, 0.5, 0.2)},
      {"column without friction", zoo::frictionless_column(6, 0.4)},
      {"plates, loaded", zoo::disks_between_plates(4, 10, 0)},
      {"biaxial box, two loaded walls", zoo::biaxial_box(3, 2, 2, 3, 0)},
      {"biaxial box with friction", zoo::biaxial_box(3, 2, 2, 3, 0.3)},
      {"rack, three loaded walls", zoo::rack(1)},
      {"groove with levers", zoo::wedge_with_levers(0.5, 0.3, 0.9, 1.25)},
      {"on fixed disks", zoo::disk_on_two_fixed(0.5, 0.4, 1, 2)},
      {"cell with imposed stress", zoo::periodic_lattice(3, 2, 0.3, 0.02)},
      {"cell whose disks touch themselves", zoo::periodic_lattice(1, 3, 0.3, 0.02)},
      {"bounds of forces", bounded_pile()},
  };
}

}  // namespace indet::test
