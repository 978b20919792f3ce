#include "libindet/io/balance.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "libindet/base/error.h"

namespace indet {
namespace {

using ::testing::HasSubstr;

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// `count` disks of radius and weight 1 on a floor, two apart; of each the floor's R = 1 and T = 0 are known.
ImportedPacking row_on_a_floor(int count) {
  ImportedPacking imported;
  Packing& packing = imported.packing;
  packing.gravity = {0, -1};
  packing.walls = {Wall{.id = 0, .point = {0, 0}, .normal = {0, 1}, .name = "floor"}};
  for (int i = 0; i < count; ++i) {
    packing.disks.push_back(
        Disk{.id = 10 + i, .position = {4.0 * i, 1}, .radius = 1, .mass = 1, .inertia = 0.5});
    packing.contacts.push_back(
        Contact{.a = DiskId(i), .b = Body::wall(WallId(0)), .normal = {0, 1}, .mu = 0.5, .R = 1, .T = 0});
  }
  return imported;
}

TEST(Balance, IsThatOfTheDisksWhoseForcesAreAllKnown) {
  ImportedPacking imported = row_on_a_floor(4);
  auto& contacts = imported.packing.contacts;
  contacts[0].R = 1.25;      // a quarter too much
  contacts[1].T = kUnknown;  // R alone does not tell the balance
  contacts[2].R = 7, contacts[2].T = kUnknown;
  const BalanceReport report = report_balance(imported);
  EXPECT_FALSE(report.forces_known);
  EXPECT_EQ(report.known_forces, 6);
  EXPECT_EQ(report.checked_disks, 2);
  EXPECT_DOUBLE_EQ(report.force_residual, 0.25);
  EXPECT_EQ(report.worst_force, DiskId(0));
  EXPECT_EQ(report.torque_residual, 0);
  require_balance(imported, report, 0.26);
  EXPECT_THAT([&] { require_balance(imported, report, 0.24); },
              ::testing::ThrowsMessage<InputError>(HasSubstr("on disk 10 the net force is 0.25 mg")));
}

/// A contact that pulls is a violation whatever its T is, and one with |T| > μR is only known by both.
TEST(Balance, KnownForcesTellOfTheCoulombConditions) {
  ImportedPacking imported = row_on_a_floor(4);
  auto& contacts = imported.packing.contacts;
  contacts[0].R = -2, contacts[0].T = kUnknown;
  contacts[1].R = kUnknown, contacts[1].T = 3;
  contacts[2].R = 1, contacts[2].T = 0.5;
  contacts[3].R = 0;
  const BalanceReport report = report_balance(imported);
  EXPECT_EQ(report.coulomb_violations, 1);
  EXPECT_DOUBLE_EQ(report.worst_violation, 2);
  EXPECT_EQ(report.sliding, 1 + 2);
  EXPECT_EQ(report.non_transmitting, 1);
}

TEST(Balance, NothingIsCheckedWithoutForcesNorOnLooseOrFixedDisks) {
  ImportedPacking imported = row_on_a_floor(3);
  auto& packing = imported.packing;
  packing.contacts[0].R = packing.contacts[0].T = kUnknown;
  packing.contacts.pop_back();  // disk 12 is loose, which a list of measured forces may leave so
  BalanceReport report = report_balance(imported);
  EXPECT_EQ(report.known_forces, 2);
  EXPECT_EQ(report.checked_disks, 1);
  EXPECT_EQ(report.loose_disks, 1);
  EXPECT_EQ(report.force_residual, 0);

  packing.contacts.pop_back();
  report = report_balance(imported);
  EXPECT_EQ(report.known_forces, 0);
  EXPECT_EQ(report.checked_disks, 0);
  EXPECT_FALSE(report.any_known());
  require_balance(imported, report, 0);

  imported = row_on_a_floor(2);  // a fixed disk bears the other, and needs no balance of its own
  imported.packing.disks[1] = {.id = 1, .position = {0, 3}, .radius = 1, .mass = 1, .inertia = 0.5};
  imported.packing.disks[0].fixed = true;
  imported.packing.contacts = {
      Contact{.a = DiskId(1), .b = Body::disk(DiskId(0)), .normal = {0, 1}, .R = 1, .T = 0}};
  report = report_balance(imported);
  EXPECT_TRUE(report.forces_known);
  EXPECT_EQ(report.checked_disks, 1);
  EXPECT_EQ(report.force_residual, 0);
}

}  // namespace
}  // namespace indet
