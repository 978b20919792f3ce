#include "libindet/verify/rebuilt_problem.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "libindet/verify/rebuilt_ellipsoid.h"
#include "tests/support/periodic_lattice.h"
#include "tests/support/zoo.h"

namespace indet {
namespace {

/// 3N equations of disks, of which two depend on the others because forces in a cell cancel, and three of the
/// stress; 3N contacts with two forces each.
TEST(RebuiltProblem, KnowsTheNullityOfLattices) {
  for (const int n : {4, 25}) {
    const Packing packing = zoo::periodic_lattice(n, n, 0.5, 0.02);
    const RebuiltProblem problem(packing);
    EXPECT_EQ(problem.nullity_by_inertia(1e-6), 3 * n * n - 1) << n;
    if (n == 4) {
      EXPECT_EQ(problem.nullity(), 3 * n * n - 1);
    }
  }
}

/// The same ellipsoid in the coordinates z of the kernel, F = F_c + Zz: σ_k = |L⁻¹ Zᵀ e_k|, LLᵀ = Σ
/// nnᵀ/slack².
void expect_the_ellipsoid_of_the_kernel(const Packing& packing, const Eigen::VectorXd& forces) {
  const RebuiltProblem problem(packing);
  const auto ellipsoid = RebuiltEllipsoid::about(problem, forces, 1e-9);
  ASSERT_TRUE(ellipsoid);
  const Eigen::MatrixXd& Z = problem.kernel();
  Eigen::MatrixXd hessian = Eigen::MatrixXd::Zero(Z.cols(), Z.cols());
  Eigen::VectorXd slope = Eigen::VectorXd::Zero(Z.cols());
  for (int h = 0; h < problem.half_planes(); ++h) {
    if (packing[ContactId(h / 2)].mu == 0 && h % 2 == 1) continue;
    const Eigen::VectorXd normal = problem.normal_of(h) / problem.slack(h, forces);
    hessian += normal * normal.transpose();
    slope += normal;
  }
  const Eigen::LLT<Eigen::MatrixXd> factor(hessian);
  EXPECT_NEAR(ellipsoid->decrement(), factor.matrixL().solve(slope).norm(), 1e-9);
  for (int k = 0; k < 2 * packing.contact_count(); ++k) {
    const double width = factor.matrixL().solve(Z.row(k).transpose()).norm();
    EXPECT_NEAR(ellipsoid->width(k), width, 1e-9 * (1 + width)) << "component " << k;
  }
}

TEST(RebuiltEllipsoid, IsThatOfTheKernel) {
  const Packing column = zoo::column(6, 0.4, 0.6);
  const auto size = static_cast<Eigen::Index>(2 * column.contact_count());
  Eigen::VectorXd forces(size);
  for (Eigen::Index k = 0; k < size; ++k) forces[k] = k % 2 == 0 ? 2 + std::sin(k) : 0.3 * std::cos(3 * k);
  expect_the_ellipsoid_of_the_kernel(column, forces);
  Packing mixed = column;
  mixed.contacts[2].mu = 0;
  forces[5] = 0;
  expect_the_ellipsoid_of_the_kernel(mixed, forces);
}

TEST(RebuiltEllipsoid, IsNotAboutAPointOnAHalfPlane) {
  const Packing column = zoo::column(3, 0.4, 0.6);
  const RebuiltProblem problem(column);
  EXPECT_FALSE(RebuiltEllipsoid::about(problem, Eigen::VectorXd::Zero(2 * column.contact_count()), 1e-9));
}

}  // namespace
}  // namespace indet
