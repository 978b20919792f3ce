#include "libindet/io/csv_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "libindet/base/error.h"
#include "libindet/io/csv_reader.h"
#include "libindet/io/csv_table.h"
#include "libindet/io/lammps_reader.h"
#include "tests/io/sample.h"
#include "tests/support/temporary_folder.h"

namespace indet {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

bool same_number(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

void expect_same(const Packing& left, const Packing& right) {
  EXPECT_EQ(left.gravity, right.gravity);
  EXPECT_EQ(left.named_force_unit, right.named_force_unit);
  ASSERT_EQ(left.disk_count(), right.disk_count());
  for (int i = 0; i < left.disk_count(); ++i) {
    const Disk& a = left[DiskId(i)];
    const Disk& b = right[DiskId(i)];
    EXPECT_TRUE(a.id == b.id && a.position == b.position && a.radius == b.radius && a.mass == b.mass &&
                a.inertia == b.inertia && a.angle == b.angle && a.velocity == b.velocity &&
                a.angular_velocity == b.angular_velocity && a.load == b.load)
        << i;
  }
  ASSERT_EQ(left.wall_count(), right.wall_count());
  for (int i = 0; i < left.wall_count(); ++i) {
    const Wall& a = left[WallId(i)];
    const Wall& b = right[WallId(i)];
    EXPECT_TRUE(a.id == b.id && a.point == b.point && a.normal == b.normal && a.name == b.name) << i;
  }
  ASSERT_EQ(left.contact_count(), right.contact_count());
  for (int i = 0; i < left.contact_count(); ++i) {
    const Contact& a = left[ContactId(i)];
    const Contact& b = right[ContactId(i)];
    EXPECT_TRUE(a.a == b.a && a.b == b.b && a.normal == b.normal && a.gap == b.gap && a.mu == b.mu &&
                same_number(a.R, b.R) && same_number(a.T, b.T))
        << i;
  }
}

TEST(CsvWriter, ASceneReadsBackToTheSamePacking) {
  const test::TemporaryFolder folder;
  Packing packing = test::sample_packing();
  write_csv_scene(folder / "scene", packing, packing.simulated_forces().value());
  expect_same(read_csv_scene(folder / "scene").packing, packing);
  packing.named_force_unit = 0.1;
  packing.gravity = {1e-3, -9.81};
  packing.walls[0].name = "a, b # c";
  write_csv_scene(folder / "scene", packing, packing.simulated_forces().value());
  expect_same(read_csv_scene(folder / "scene").packing, packing);
}

TEST(CsvWriter, ARealPackingReadsBackToTheSamePacking) {
  const test::TemporaryFolder folder;
  const std::string data = std::string(INDET_TEST_DATA) + "/lammps/";
  const Packing packing =
      read_lammps({data + "atoms.dump", data + "contacts.dump", {}}, {.friction = FrictionRule(0.3)}).packing;
  write_csv_scene(folder.path(), packing, packing.simulated_forces().value());
  expect_same(read_csv_scene(folder.path()).packing, packing);
}

TEST(CsvWriter, TheTableHasARowAContactAndForcesInOneUnit) {
  const test::TemporaryFolder folder;
  const Packing packing = test::sample_packing();
  const ForceRanges ranges = test::sample_ranges();
  write_contact_table(folder / "c.csv", packing, ranges.states.row(2).transpose(), &ranges);
  const Table table = read_csv(folder / "c.csv");
  ASSERT_EQ(table.rows(), 5);
  EXPECT_EQ(table.integer(2, "contact"), 2);
  EXPECT_EQ(table.integer(2, "a"), 10);
  EXPECT_EQ(table.integer(2, "b"), -10);
  const double mg = packing.force_unit();
  ASSERT_NE(mg, 1);
  EXPECT_EQ(table.number(2, "R_mg"), 2004.5 / mg);
  EXPECT_EQ(table.number(2, "T_mg"), 2005.5 / mg);
  EXPECT_EQ(table.text(2, "R_max_mg"), "inf");
  EXPECT_EQ(table.number(3, "R_min_mg"), 130 / mg);
  EXPECT_TRUE(table.is_empty(3, "T_min_mg"));
  EXPECT_EQ(table.text(3, "T_min_outcome"), "optimal");
  EXPECT_EQ(table.number(4, "delta_T_mg"), 10);
  write_contact_table(folder / "p.csv", packing, packing.simulated_forces().value(), nullptr);
  EXPECT_FALSE(read_csv(folder / "p.csv").has("R_max_mg"));
}

TEST(CsvWriter, AFolderThatCannotBeMadeIsNamed) {
  const test::TemporaryFolder folder;
  folder.write("file", "");
  const Packing packing = test::sample_packing();
  EXPECT_THAT(
      [&] { write_csv_scene(folder / "file" / "scene", packing, packing.simulated_forces().value()); },
      ThrowsMessage<UnwritablePath>(HasSubstr("scene: cannot be written (Not a directory)")));
}

}  // namespace
}  // namespace indet
