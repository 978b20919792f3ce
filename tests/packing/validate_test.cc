#include "libindet/packing/validate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <ostream>

#include "libindet/base/error.h"

namespace indet {
namespace {

using ::testing::HasSubstr;

/// Two disks side by side on a floor.
Packing two_disks() {
  Packing packing;
  packing.gravity = {0, -1};
  packing.walls = {Wall{.id = 0, .point = {0, 0}, .normal = {0, 1}, .name = "floor"}};
  for (int i = 0; i < 2; ++i) {
    packing.disks.push_back(Disk{.id = i, .position = {2.0 * i, 1}, .radius = 1, .mass = 1, .inertia = 0.5});
    packing.contacts.push_back(
        Contact{.a = DiskId(i), .b = Body::wall(WallId(0)), .normal = {0, 1}, .mu = 0.3});
  }
  packing.contacts.push_back(
      Contact{.a = DiskId(1), .b = Body::disk(DiskId(0)), .normal = {1, 0}, .mu = 0.3});
  return packing;
}

TEST(Validate, AcceptsASoundPacking) { EXPECT_FALSE(find_defect(two_disks()).has_value()); }

struct BadPacking {
  const char* name;
  std::function<void(Packing&)> spoil;
  PackingPart part;
  int index;
  const char* reason;
};

void PrintTo(const BadPacking& bad, std::ostream* stream) { *stream << bad.name; }

class ValidateBad : public ::testing::TestWithParam<BadPacking> {};

TEST_P(ValidateBad, NamesPartRowAndReason) {
  Packing packing = two_disks();
  GetParam().spoil(packing);
  const auto defect = find_defect(packing);
  ASSERT_TRUE(defect.has_value());
  EXPECT_EQ(defect->part, GetParam().part);
  EXPECT_EQ(defect->index, GetParam().index);
  EXPECT_THAT(defect->reason, HasSubstr(GetParam().reason));
  EXPECT_THROW(validate(packing, "file"), InputError);
}

const double kNaN = std::numeric_limits<double>::quiet_NaN();
const double kInf = std::numeric_limits<double>::infinity();

INSTANTIATE_TEST_SUITE_P(
    All, ValidateBad,
    ::testing::Values(
        BadPacking{"NanPosition", [](Packing& p) { p.disks[1].position.x() = kNaN; }, PackingPart::kDisk, 1,
                   "x must be a finite"},
        BadPacking{"InfiniteMass", [](Packing& p) { p.disks[0].mass = kInf; }, PackingPart::kDisk, 0,
                   "mass must be a finite"},
        BadPacking{"ZeroRadius", [](Packing& p) { p.disks[1].radius = 0; }, PackingPart::kDisk, 1,
                   "radius must be positive"},
        BadPacking{"NegativeMass", [](Packing& p) { p.disks[1].mass = -1; }, PackingPart::kDisk, 1,
                   "mass must be positive"},
        BadPacking{"NegativeFriction", [](Packing& p) { p.contacts[2].mu = -0.1; }, PackingPart::kContact, 2,
                   "mu must not be negative"},
        BadPacking{"NanFriction", [](Packing& p) { p.contacts[2].mu = kNaN; }, PackingPart::kContact, 2,
                   "mu must be a finite"},
        BadPacking{"DiskOutOfRange", [](Packing& p) { p.contacts[0].a = DiskId(2); }, PackingPart::kContact,
                   0, "body a is disk 2"},
        BadPacking{"WallOutOfRange", [](Packing& p) { p.contacts[1].b = Body::wall(WallId(1)); },
                   PackingPart::kContact, 1, "wall 1"},
        BadPacking{"Itself", [](Packing& p) { p.contacts[2].b = Body::disk(DiskId(1)); },
                   PackingPart::kContact, 2, "cannot touch itself"},
        BadPacking{
            "Twice",
            [](Packing& p) {
              p.contacts.push_back(Contact{.a = DiskId(0), .b = Body::disk(DiskId(1)), .normal = {-1, 0}});
            },
            PackingPart::kContact, 3, "also contact 2"},
        BadPacking{"LongNormal",
                   [](Packing& p) {
                     p.contacts[2].normal = {2, 0};
                   },
                   PackingPart::kContact, 2, "length 2"},
        BadPacking{"OppositeNormal",
                   [](Packing& p) {
                     p.contacts[2].normal = {-1, 0};
                   },
                   PackingPart::kContact, 2, "disagrees with the positions"},
        BadPacking{"WallNormal",
                   [](Packing& p) {
                     p.walls[0].normal = {0, 0.5};
                   },
                   PackingPart::kWall, 0, "length 0.5"},
        BadPacking{"InfiniteLoad", [](Packing& p) { p.walls[0].load_t = kInf; }, PackingPart::kWall, 0,
                   "load_t must be a finite number or empty"},
        BadPacking{"BehindAWall", [](Packing& p) { p.walls[0].point.y() = 1; }, PackingPart::kContact, 0,
                   "the centre of disk 0 is behind wall 0"},
        BadPacking{"FarFromAWall", [](Packing& p) { p.walls[0].point.y() = -27; }, PackingPart::kContact, 0,
                   "disk 0 and wall 0 are 27 apart, more than the radius 1"},
        BadPacking{"FarFromADisk", [](Packing& p) { p.disks[1].position.x() = 3.5; }, PackingPart::kContact, 2,
                   "disk 1 and disk 0 are 1.5 apart, more than the radius 1"},
        BadPacking{"InsideADisk",
                   [](Packing& p) {
                     p.disks[1].radius = 0.5;
                     p.disks[1].position = {0.25, 0.5};
                     p.disks[0].position.y() = 0.5;
                   },
                   PackingPart::kContact, 2, "disk 1 and disk 0 overlap by 1.25, more than the diameter 1 of the "
                                             "smaller one"},
        BadPacking{"InfiniteForce", [](Packing& p) { p.contacts[0].R = kInf; }, PackingPart::kContact, 0,
                   "finite or unknown"},
        BadPacking{"NoLever", [](Packing& p) { p.contacts[2].lever_b = 0; }, PackingPart::kContact, 2,
                   "lever_b must be positive"},
        BadPacking{"LongLever", [](Packing& p) { p.contacts[0].lever_a = 2.5; }, PackingPart::kContact, 0,
                   "more than the diameter 2"},
        BadPacking{"LeverOfAWall", [](Packing& p) { p.contacts[0].lever_b = 1; }, PackingPart::kContact, 0,
                   "a wall, which has no lever"},
        BadPacking{"FixedOnAWall", [](Packing& p) { p.disks[1].fixed = true; }, PackingPart::kContact, 1,
                   "nothing has to balance"},
        BadPacking{"FixedOfNegativeMass",
                   [](Packing& p) {
                     p.disks[0].fixed = true;
                     p.disks[0].mass = -1;
                   },
                   PackingPart::kDisk, 0, "mass must not be negative"}),
    [](const auto& instance) { return instance.param.name; });

TEST(Packing, ForceUnitIsTheMeanWeight) {
  Packing packing = two_disks();
  packing.disks[1].mass = 3;
  packing.gravity = {0.6, -0.8};
  EXPECT_DOUBLE_EQ(packing.force_unit(), 2);
  packing.named_force_unit = 5;
  EXPECT_DOUBLE_EQ(packing.force_unit(), 5);
}

TEST(Packing, ForceUnitWithoutWeightIsTheLargestLoad) {
  Packing packing = two_disks();
  packing.gravity.setZero();
  EXPECT_FALSE(packing.has_weight());
  EXPECT_EQ(packing.force_unit(), 1);
  packing.contacts[0].R = 0.25;
  packing.contacts[0].T = -0.5;
  EXPECT_EQ(packing.force_unit(), 0.5);
  packing.disks[1].load = {-3, 1, 0};
  EXPECT_EQ(packing.force_unit(), 3);
  EXPECT_EQ(packing.internal_force_unit(), 3);
  packing.disks[1].fixed = true;  // what acts on it has no part
  EXPECT_EQ(packing.force_unit(), 0.5);
}

TEST(Validate, TheUnitOfForceHasASquare) {
  for (const double unit : {1e-320, 1e-151, 1e151}) {
    Packing packing = two_disks();
    packing.named_force_unit = unit;
    ASSERT_TRUE(find_defect(packing).has_value()) << unit;
    EXPECT_THAT(find_defect(packing)->reason, testing::HasSubstr("the unit of force has to be from 1e-150"));
    packing.named_force_unit = 0;
    for (Disk& disk : packing.disks) disk.mass = unit;
    EXPECT_TRUE(find_defect(packing).has_value()) << unit;
  }
}

TEST(Validate, AFixedDiskNeedsNoMass) {
  Packing packing = two_disks();
  packing.disks[0].fixed = true;
  packing.disks[0].mass = packing.disks[0].inertia = 0;
  packing.contacts.erase(packing.contacts.begin());
  EXPECT_FALSE(find_defect(packing).has_value());
}

TEST(Packing, FixedDisksHaveNoWeight) {
  Packing packing = two_disks();
  packing.disks[0].fixed = true;
  packing.disks[0].mass = 5;
  packing.disks[0].load = {1, 2, 3};
  EXPECT_EQ(packing.free_disk_count(), 1);
  EXPECT_EQ(packing.force_unit(), 1);
  EXPECT_EQ(packing.wrench(DiskId(0)), Vector3(0, 0, 0));
  EXPECT_EQ(packing.wrench(DiskId(1)), Vector3(0, -1, 0));
}

TEST(Packing, TheLeverIsTheRadiusUnlessGiven) {
  Packing packing = two_disks();
  packing.disks[0].radius = 0.75;
  EXPECT_EQ(packing.lever_a(ContactId(2)), 1);
  EXPECT_EQ(packing.lever_b(ContactId(2)), 0.75);
  EXPECT_EQ(packing.lever_b(ContactId(1)), 0);
  packing.contacts[2].lever_a = 0.9;
  packing.contacts[2].lever_b = 0.7;
  EXPECT_EQ(packing.lever_a(ContactId(2)), 0.9);
  EXPECT_EQ(packing.lever_b(ContactId(2)), 0.7);
}

TEST(Packing, LoadedWallsTakeTheirDirectionsFromTheLeastNullity) {
  Packing packing = two_disks();
  EXPECT_EQ(packing.expected_dimension(), 0);
  packing.walls[0].load_n = 2;
  EXPECT_EQ(packing.expected_dimension(), -1);
  EXPECT_TRUE(packing.has_equations(Body::wall(WallId(0))));
  EXPECT_FALSE(packing.is_free_disk(Body::wall(WallId(0))));
  packing.walls[0].load_t = 0;
  EXPECT_EQ(packing.expected_dimension(), -2);
}

TEST(Packing, GapIsNegativeWhereDisksOverlap) {
  Packing packing = two_disks();
  packing.disks[1].position = {1.5, 1.25};
  EXPECT_NEAR(geometric_gap(packing, DiskId(1), Body::disk(DiskId(0))), std::hypot(1.5, 0.25) - 2, 1e-15);
  EXPECT_NEAR(geometric_gap(packing, DiskId(1), Body::wall(WallId(0))), 0.25, 1e-15);
}

}  // namespace
}  // namespace indet
