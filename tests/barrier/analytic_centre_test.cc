#include "libindet/barrier/analytic_centre.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "tests/barrier/sets.h"

namespace indet::barrier {
namespace {

using test::Named;
using test::packings;
using test::StrengthSet;
using test::vector;

/// R_1, T_1, R_2, … at the centre, in the scene's units.
Eigen::VectorXd forces_at_centre(const Packing& packing) {
  StrengthSet set(packing);
  const AnalyticCentre centre = find_analytic_centre(set.structure, set.cholesky);
  EXPECT_TRUE(centre.found);
  return set.problem.edge_forces * vector(centre.x) * set.problem.units.internal_in_scene();
}

/// A x = b, x > 0, x_k (Aᵀ y)_k = 1.
TEST(AnalyticCentre, SatisfiesItsEquations) {
  for (const auto& [name, packing] : packings()) {
    SCOPED_TRACE(name);
    StrengthSet set(packing);
    const AnalyticCentre centre = find_analytic_centre(set.structure, set.cholesky);
    ASSERT_TRUE(centre.found);
    EXPECT_LE(centre.iterations, 30);
    const Eigen::MatrixXd A = set.matrix();
    const Eigen::VectorXd x = vector(centre.x);
    EXPECT_GT(x.minCoeff(), 0);
    EXPECT_LE((A * x - vector(set.structure.load())).lpNorm<Eigen::Infinity>(),
              1e-9 * std::max(1.0, x.maxCoeff()));
    EXPECT_LE((x.array() * (A.transpose() * vector(centre.y)).array() - 1).abs().maxCoeff(), 1e-5);
    // The equations that were left out as dependent hold as well.
    EXPECT_LE((set.problem.edge_matrix * x - set.problem.load()).lpNorm<Eigen::Infinity>(),
              1e-8 * std::max(1.0, x.maxCoeff()));
  }
}

/// Another start, another path, the same centre: Σ log x grows in no direction of the set.
TEST(AnalyticCentre, IsWhereTheProductOfStrengthsIsLargest) {
  for (const auto& [name, packing] : packings()) {
    SCOPED_TRACE(name);
    StrengthSet set(packing);
    const AnalyticCentre centre = find_analytic_centre(set.structure, set.cholesky);
    ASSERT_TRUE(centre.found);
    const Eigen::MatrixXd A = set.matrix();
    // The projection of 1/x onto the kernel of A, in the metric of x.
    const Eigen::MatrixXd AX = A * vector(centre.x).asDiagonal();
    const Eigen::VectorXd one = Eigen::VectorXd::Ones(AX.cols());
    const Eigen::VectorXd w = (AX * AX.transpose()).ldlt().solve(AX * one);
    EXPECT_LE((one - AX.transpose() * w).norm(), 1e-5);
  }
}

/// With R = a + b T, a = 1/(2 cos φ), b = tan φ at both contacts, R² − T²/μ² is largest at
/// T = a b μ² / (1 − b² μ²).
TEST(AnalyticCentre, OfAGrooveHasAClosedForm) {
  for (const double phi : {0.1, 0.5, 1.0}) {
    for (const double mu : {0.1, 0.5}) {
      const double a = 0.5 / std::cos(phi);
      const double b = std::tan(phi);
      const double T = a * b * mu * mu / (1 - b * b * mu * mu);
      const Eigen::VectorXd F = forces_at_centre(zoo::wedge(phi, mu));
      EXPECT_LE((F - Eigen::Vector4d(a + b * T, T, a + b * T, -T)).norm(), 1e-5);
    }
  }
}

/// A point is its own centre.
TEST(AnalyticCentre, OfAColumnWithoutFrictionIsItsOnlyState) {
  const int count = 8;
  const double theta = 0.4;
  const Eigen::VectorXd F = forces_at_centre(zoo::frictionless_column(count, theta));
  EXPECT_NEAR(F[0], count, 1e-7);
  for (int k = 1; k < count; ++k) EXPECT_NEAR(F[2 * k], (count - k) / std::cos(theta), 1e-7);
  for (int k = 0; k < count; ++k) {
    const double above = (k == 0 ? 0 : count - k) + (count - k - 1);
    EXPECT_NEAR(F[2 * (count + k)], above * std::tan(theta), 1e-7);
  }
}

/// Equal disks share a plate's load, rows and columns of a box theirs, and the three contacts of a rack
/// (√3/2) load.
TEST(AnalyticCentre, SharesEvenlyWhatIsSharedAlike) {
  const Eigen::VectorXd plates = forces_at_centre(zoo::disks_between_plates(5, 10, 0));
  for (int k = 0; k < 5; ++k) {
    EXPECT_NEAR(plates[2 * k], 3, 1e-5);
    EXPECT_NEAR(plates[2 * (5 + k)], 2, 1e-5);
  }
  const Eigen::VectorXd rack = forces_at_centre(zoo::rack(3));
  int between_disks = 0;
  const Packing packing = zoo::rack(3);
  for (int i = 0; i < packing.contact_count(); ++i) {
    if (packing[ContactId(i)].b.is_wall()) continue;
    EXPECT_NEAR(rack[2 * i], 3 * std::sqrt(3) / 6, 1e-5);
    ++between_disks;
  }
  EXPECT_EQ(between_disks, 3);
  const Eigen::VectorXd box = forces_at_centre(zoo::biaxial_box(3, 2, 4, 3, 0));
  for (Eigen::Index i = 0; i < box.size(); i += 2)
    EXPECT_NEAR(box[i], std::abs(box[i] - 2) < 0.5 ? 2 : 1, 1e-5);
}

TEST(AnalyticCentre, DoesNotHangOnTheUnitsOfTheScene) {
  const Packing pile = zoo::column(6, 0.4, 0.3);
  const Eigen::VectorXd plain = forces_at_centre(pile);
  for (const double factor : {1e-60, 1e-6, 1e6, 1e60}) {
    EXPECT_LE((forces_at_centre(zoo::rescaled(pile, 1, 1, factor)) / factor - plain).norm(), 1e-5);
    EXPECT_LE((forces_at_centre(zoo::rescaled(pile, factor, 1, 1)) - plain).norm(), 1e-5);
  }
}

/// Where there is none the search ends, and says so.
TEST(AnalyticCentre, IsNotFoundWhereThereIsNone) {
  const double critical = zoo::spun_wedge_critical_torque(0.6, 0.3);
  const Named none[] = {
      {"empty: pyramid", zoo::pyramid(0.7, 0.1, 0.5)},
      {"empty: spun", zoo::spun_wedge(0.6, 0.3, 1.1 * critical)},
      {"empty: lattice", zoo::lattice_pile(3, 0.1)},
      {"unbounded: jammed groove", zoo::wedge(1.3, 0.5)},
      {"unbounded: pinched", zoo::pinched_disk(0.5)},
      {"unbounded: column between walls", zoo::column_between_walls(5, 0.3)},
      {"unbounded: corner", zoo::corner(1.1, 1.5)},
      {"unbounded: one of two grooves", zoo::two_wedges(0.3, 0.3, 1.3, 0.5)},
      {"closed edges: corner", zoo::corner(0.5, 0.5)},
      {"closed edges: corner slides", zoo::corner(0.5, 1.0)},
      {"closed edges: corner beside a groove", zoo::wedge_and_corner(0.3, 0.3)},
      {"closed edges: spun", zoo::spun_wedge(0.6, 0.3, critical)},
  };
  for (const auto& [name, packing] : none) {
    SCOPED_TRACE(name);
    StrengthSet set(packing);
    const AnalyticCentre centre = find_analytic_centre(set.structure, set.cholesky);
    EXPECT_FALSE(centre.found);
    EXPECT_LE(centre.iterations, 200);
  }
}

/// An equation that was left out as dependent, but contradicts the others by its load, is no matter of the
/// centre: it is for the caller to see.
TEST(AnalyticCentre, DoesNotSeeEquationsThatWereLeftOut) {
  for (const Packing& packing : {zoo::disk_on_incline(0.1, 0.3), zoo::wedge_and_loose_disk(0.3, 0.3, 1)}) {
    StrengthSet set(packing);
    EXPECT_LT(set.structure.rows(), set.problem.equations());
    const AnalyticCentre centre = find_analytic_centre(set.structure, set.cholesky);
    ASSERT_TRUE(centre.found);
    EXPECT_GT((set.problem.edge_matrix * vector(centre.x) - set.problem.load()).norm(), 0.05);
  }
}

TEST(AnalyticCentre, OfNothingIsNothing) {
  Packing nothing;
  nothing.named_force_unit = 1;
  StrengthSet set(nothing);
  const AnalyticCentre centre = find_analytic_centre(set.structure, set.cholesky);
  EXPECT_TRUE(centre.found);
  EXPECT_TRUE(centre.x.empty());
}

/// One disk on the floor without friction: a point with a single unknown.
TEST(AnalyticCentre, MayBeOfOneUnknown) { EXPECT_NEAR(forces_at_centre(zoo::disk_on_floor(0))[0], 1, 1e-9); }

}  // namespace
}  // namespace indet::barrier
