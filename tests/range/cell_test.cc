#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "libindet/equilibrium/contact_state.h"
#include "libindet/range/analyze.h"
#include "tests/support/compare.h"
#include "tests/support/periodic_lattice.h"

namespace indet {
namespace {

using zoo::periodic_lattice;

TEST(Cell, AllFormulationsAgree) {
  const Packing packing = periodic_lattice(3, 2, 0.3, 0.02);
  AnalyzeOptions options;
  options.formulation = Formulation::kEdge;
  const ForceRanges right = analyze(packing, options);
  ASSERT_EQ(right.status, PolytopeStatus::kBounded);
  EXPECT_EQ(right.dim, packing.expected_dimension());
  EXPECT_EQ(right.certified, 4 * 18);
  for (Eigen::Index i = 0; i < right.lower.size(); ++i) {
    EXPECT_LT(right.upper.data()[i] - right.lower.data()[i], 1e-6);
  }
  for (const Formulation formulation : {Formulation::kDual, Formulation::kNullSpace}) {
    options.formulation = formulation;
    EXPECT_TRUE(test::same_entries(right.value, analyze(packing, options).value, 1e-10))
        << to_string(formulation);
  }
  options.method = Method::kPivotingTableau;
  EXPECT_TRUE(test::same_entries(right.value, analyze(packing, options).value, 1e-10));
}

/// Each disk may be represented by any of its images.
TEST(Cell, DoesNotSeeWhereDisksAreCut) {
  const Packing packing = periodic_lattice(3, 2, 0.3, 0.02);
  Packing moved = packing;
  const Image jumps[] = {{2, 0}, {0, -1}, {0, 0}, {-1, 3}, {5, 1}, {0, 0}};
  for (int i = 0; i < moved.disk_count(); ++i) {
    const auto [along_a, along_b] = jumps[i];
    moved.disks[static_cast<std::size_t>(i)].position +=
        along_a * *packing.cell.a + along_b * *packing.cell.b;
  }
  for (Contact& contact : moved.contacts) {
    for (const std::size_t k : {0U, 1U})
      contact.image[k] += jumps[contact.a.value()][k] - jumps[contact.b.disk_id().value()][k];
  }
  EXPECT_TRUE(test::same_entries(analyze(packing).value, analyze(moved).value, 1e-9));
}

/// Turning the whole scene turns the stress tensor with it.
TEST(Cell, DoesNotSeeHowTheSceneIsTurned) {
  const Packing packing = periodic_lattice(3, 2, 0.3, 0.02);
  Packing turned = packing;
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(0.7).toRotationMatrix();
  for (Disk& disk : turned.disks) disk.position = turn * disk.position;
  turned.cell.a = turn * *packing.cell.a;
  turned.cell.b = turn * *packing.cell.b;
  for (Contact& contact : turned.contacts) contact.normal = turn * contact.normal;
  Eigen::Matrix2d stress;
  stress << packing.stress.xx, packing.stress.xy, packing.stress.xy, packing.stress.yy;
  // σ_yx is that of σ_xy only where levers meet: l_a + l_b = |l|.
  Packing met = packing;
  for (std::size_t i = 0; i < met.contacts.size(); ++i) {
    const double lever = 0.5 * met.branch(met.contacts[i]).norm();
    for (Packing* scene : {&met, &turned}) scene->contacts[i].lever_a = scene->contacts[i].lever_b = lever;
  }
  stress = turn * stress * turn.transpose();
  turned.stress.xx = stress(0, 0);
  turned.stress.yy = stress(1, 1);
  turned.stress.xy = stress(0, 1);
  EXPECT_TRUE(test::same_entries(analyze(met).value, analyze(turned).value, 1e-9));
}

TEST(Cell, StatesMakeTheStressThatIsImposed) {
  const Packing packing = periodic_lattice(3, 3, 0.4, 0.01);
  const ForceRanges ranges = analyze(packing);
  ASSERT_GT(ranges.states.rows(), 0);
  for (Eigen::Index k = 0; k < ranges.states.rows(); ++k) {
    const SceneForces forces(ranges.states.row(k).transpose());
    const Eigen::Matrix2d stress = contact_stress(packing, forces);
    EXPECT_NEAR(stress(0, 0), 1, 1e-12);
    EXPECT_NEAR(stress(1, 1), 1.1, 1e-12);
    EXPECT_NEAR(stress(0, 1), 0.05, 1e-12);
    EXPECT_LT(stress_residual(packing, forces).cwiseAbs().maxCoeff(), 1e-12);
  }
}

/// The sensitivity is that of ranges whose normals were turned: no value moves by more than it says, and
/// some by nearly as much.
TEST(Cell, SensitivityBoundsWhatTurnedNormalsDo) {
  const Packing packing = periodic_lattice(2, 2, 0.3, 0.02);
  const ForceRanges before = analyze(packing);
  constexpr double kAngle = 1e-7;
  Packing turned = packing;
  for (std::size_t i = 0; i < turned.contacts.size(); ++i) {
    const double angle = i % 3 == 0 ? kAngle : -kAngle;
    turned.contacts[i].normal = Eigen::Rotation2Dd(angle) * packing.contacts[i].normal;
  }
  const ForceRanges after = analyze(turned);
  double nearest = 0;
  for (Eigen::Index i = 0; i < before.value.size(); ++i) {
    const double moved = std::abs(after.value.data()[i] - before.value.data()[i]) / kAngle;
    EXPECT_LE(moved, before.sensitivity.value.data()[i] * (1 + 1e-4) + 1e-4) << i;
    if (before.sensitivity.value.data()[i] > 0)
      nearest = std::max(nearest, moved / before.sensitivity.value.data()[i]);
  }
  EXPECT_GT(nearest, 0.1);
}

/// One disk, frictionless, at a pressure p: Σ R / 2 = A p, A = √3/2, so that R_1 + R_2 + R_3 = √3 p.
TEST(Cell, OneDiskAtAPressureHasASimplex) {
  Packing packing = periodic_lattice(1, 1, 0, 0);
  packing.stress = {};
  packing.stress.pressure = 1;
  const ForceRanges ranges = analyze(packing);
  const double sum = std::sqrt(3);
  ASSERT_EQ(ranges.dim, 2);
  for (Eigen::Index i = 0; i < 3; ++i) {
    EXPECT_NEAR(ranges.value(i, kMinR), 0, 1e-14);
    EXPECT_NEAR(ranges.value(i, kMaxR), sum, 1e-14);
  }
}

TEST(Cell, WhatCannotStandMovesTheCell) {
  Packing packing = periodic_lattice(2, 2, 0.3, 0);
  packing.stress = {};
  packing.stress.pressure = -1;
  const ForceRanges ranges = analyze(packing);
  ASSERT_EQ(ranges.status, PolytopeStatus::kEmpty);
  ASSERT_EQ(ranges.cell_motion.rows(), 2);
  EXPECT_FALSE(ranges.doubtful);
  EXPECT_LT(ranges.cell_motion(0, 0), 0) << "it grows";
  EXPECT_EQ(ranges.cell_motion(0, 0), ranges.cell_motion(1, 1));
  EXPECT_EQ(ranges.cell_motion(0, 1), 0);
  EXPECT_EQ(ranges.cell_motion(1, 0), 0);
}

}  // namespace
}  // namespace indet
