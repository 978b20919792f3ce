#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "libindet/exact/contact_problem.h"

namespace indet::exact {

/// A virtual motion as files hold it (ForcePolytope::motion): x, y and rω of each disk [N, 3], walls along
/// normal and tangent [W, 2] or none, the rate of compression of the cell times its length [2, 2] or none,
/// and the multipliers of force_bounds() [B].
struct BodyMotion {
  Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> disks;
  Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor> walls, cell;
  Eigen::VectorXd bounds;
};

/// The motion with these velocities, one a row of the problem.
BodyMotion on_bodies(const Packing& packing, const ContactProblem& problem, std::span<const double> rows);

/// The velocities of the problem's rows; bodies without a row have no part in it. Precondition: the shapes
/// are those of the packing.
std::vector<double> on_rows(const Packing& packing, const ContactProblem& problem, const BodyMotion& motion);

}  // namespace indet::exact
