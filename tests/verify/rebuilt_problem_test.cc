#include "libindet/verify/rebuilt_problem.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "libindet/range/analyze.h"
#include "libindet/verify/rebuilt_ellipsoid.h"
#include "libindet/verify/sparse_optimality.h"
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

/// By the half-planes of an extremum's own state, and by those of other extrema.
TEST(SparseOptimality, AgreesWithTheKernel) {
  int optimal = 0;
  for (const Packing& packing :
       {zoo::pyramid(0.8, 1, 1), zoo::wedge(0.4, 0.3), zoo::column(9, 0.4, 0.3), zoo::random_pile(4, 12, 0.4),
        zoo::random_pile(6, 12, -1), zoo::random_pile(7, 12, -1), zoo::lattice_pile(4, 0.6)}) {
    const ForceRanges ranges = analyze(packing);
    const RebuiltProblem problem(packing);
    for (int contact = 0; contact < packing.contact_count(); ++contact) {
      for (const int column : {kMaxR, kMaxT}) {
        for (const int other : {contact, (contact + 7) % packing.contact_count()}) {
          const int row = ranges.vertex(other, column);
          if (row < 0) continue;
          const std::vector<int> active(ranges.active.row(row).begin(), ranges.active.row(row).end());
          const int component = 2 * contact + (column == kMaxT ? 1 : 0);
          const double gap = sparse_optimality_gap(problem, component, 1, active);
          const bool is_optimal = problem.optimality_gap(component, 1, active) < 1e-9;
          EXPECT_EQ(gap < 1e-9, is_optimal) << contact << " " << column << " " << other << " " << gap;
          optimal += is_optimal ? 1 : 0;
        }
      }
    }
  }
  EXPECT_GT(optimal, 50);
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
