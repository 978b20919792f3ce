#include "libindet/io/csv_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "libindet/base/error.h"
#include "tests/support/temporary_folder.h"

namespace indet {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* kDisks = "id,x,y,radius,mass\n10,0,1,1,2\n7,1.6,2.2,1,2\n";
constexpr const char* kWalls = "id,px,py,nx,ny\n3,0,0,0,1\n";
constexpr const char* kContacts = "a,b,nx,ny,mu\n7,10,0.8,0.6,0.3\n10,-4,0,1,0.3\n";
constexpr const char* kScene = "gravity = [0, -1]\n";

void write_scene(const test::TemporaryFolder& folder) {
  folder.write("disks.csv", kDisks);
  folder.write("walls.csv", kWalls);
  folder.write("contacts.csv", kContacts);
  folder.write("scene.toml", kScene);
}

TEST(CsvReader, ReadsASceneByTheIdsOfItsDisksAndWalls) {
  const test::TemporaryFolder folder;
  write_scene(folder);
  const ImportedPacking imported = read_csv_scene(folder.path());
  const Packing& packing = imported.packing;
  ASSERT_EQ(packing.disk_count(), 2);
  EXPECT_EQ(packing.disks[1].id, 7);
  EXPECT_EQ(packing.disks[1].position, Vector2(1.6, 2.2));
  EXPECT_EQ(packing.disks[1].inertia, 1);
  ASSERT_EQ(packing.wall_count(), 1);
  EXPECT_EQ(packing.walls[0].id, 3);
  ASSERT_EQ(packing.contact_count(), 2);
  EXPECT_EQ(packing.contacts[0].a, DiskId(1));
  EXPECT_EQ(packing.contacts[0].b, Body::disk(DiskId(0)));
  EXPECT_EQ(packing.contacts[1].b, Body::wall(WallId(0)));
  EXPECT_EQ(packing.contacts[1].mu, 0.3);
  EXPECT_NEAR(packing.contacts[0].gap, 0, 1e-15);
  EXPECT_FALSE(packing.has_simulated_forces());
  EXPECT_EQ(packing.gravity, Vector2(0, -1));
  EXPECT_THAT(imported.warnings, IsEmpty());
}

TEST(CsvReader, ReadsEveryOptionalColumnInAnyOrder) {
  const test::TemporaryFolder folder;
  folder.write("disks.csv",
               "torque,fy,fx,omega,vy,vx,angle,inertia,mass,radius,y,x,id\n"
               "0.7,0.6,0.5,0.4,0.3,0.2,0.1,3,2,1,1,0,0\n"
               ",,,,,,,,2,1,1,5,1\n");
  folder.write("walls.csv", "id,name,px,py,nx,ny\n0,floor,0,0,0,1\n");
  folder.write("contacts.csv", "T,R,b,a,gap\n-0.5,2,-1,0,1e-3\n,,-1,1,\n");
  folder.write("scene.toml", "gravity = [0.5, -2]\nforce_unit = 4\nmu = 0.25\n");
  const Packing packing = read_csv_scene(folder.path()).packing;
  EXPECT_EQ(packing.disks[0].load, Vector3(0.5, 0.6, 0.7));
  EXPECT_EQ(packing.disks[0].velocity, Vector2(0.2, 0.3));
  EXPECT_EQ(packing.disks[0].angular_velocity, 0.4);
  EXPECT_EQ(packing.disks[0].angle, 0.1);
  EXPECT_EQ(packing.disks[0].inertia, 3);
  EXPECT_EQ(packing.disks[1].inertia, 1);
  EXPECT_EQ(packing.disks[1].load, Vector3(0, 0, 0));
  EXPECT_EQ(packing.walls[0].name, "floor");
  EXPECT_EQ(packing.contacts[0].R, 2);
  EXPECT_EQ(packing.contacts[0].T, -0.5);
  EXPECT_EQ(packing.contacts[0].gap, 1e-3);
  EXPECT_EQ(packing.contacts[0].normal, Vector2(0, 1));
  EXPECT_EQ(packing.contacts[0].mu, 0.25);
  EXPECT_TRUE(std::isnan(packing.contacts[1].R));
  EXPECT_TRUE(std::isnan(packing.contacts[1].T));
  EXPECT_EQ(packing.force_unit(), 4);
  EXPECT_EQ(packing.gravity, Vector2(0.5, -2));
}

TEST(CsvReader, AcceptsByteOrderMarkCarriageReturnsCommentsQuotesAndBlankLines) {
  const test::TemporaryFolder folder;
  write_scene(folder);
  folder.write("disks.csv",
               "\xEF\xBB\xBF# two disks\r\n\r\n\"id\", x, y,radius,mass # a header\r\n"
               "10,0,1,+1,2\r\n  \r\n# between\r\n7,1.6,2.2,1.0e0,\"2\"");
  EXPECT_EQ(read_csv_scene(folder.path()).packing.disks[1].mass, 2);
}

TEST(CsvReader, WithoutWallsAndSceneThereIsGravityAndNoWall) {
  const test::TemporaryFolder folder;
  folder.write("disks.csv", kDisks);
  folder.write("contacts.csv", "a,b,mu\n7,10,0.3\n");
  const Packing packing = read_csv_scene(folder.path()).packing;
  EXPECT_EQ(packing.wall_count(), 0);
  EXPECT_EQ(packing.gravity, Vector2(0, -1));
  EXPECT_NEAR((packing.contacts[0].normal - Vector2(0.8, 0.6)).norm(), 0, 1e-15);
}

TEST(CsvReader, RoundedNormalsGetUnitLength) {
  const test::TemporaryFolder folder;
  write_scene(folder);
  folder.write("contacts.csv", "a,b,nx,ny,mu\n7,10,0.8000003,0.6,0.3\n");
  EXPECT_NEAR(read_csv_scene(folder.path()).packing.contacts[0].normal.norm(), 1, 1e-15);
}

/// T is part of what is known of a contact without friction, unless its R is not.
TEST(CsvReader, AFrictionlessContactHasNoTangentialForce) {
  const test::TemporaryFolder folder;
  write_scene(folder);
  folder.write("contacts.csv", "a,b,mu,R\n7,10,0,1.5\n10,-4,0,\n");
  const Packing packing = read_csv_scene(folder.path()).packing;
  EXPECT_EQ(packing.contacts[0].T, 0);
  EXPECT_TRUE(std::isnan(packing.contacts[1].T));
}

TEST(CsvReader, WarnsOfContactsThatAreFarApart) {
  const test::TemporaryFolder folder;
  write_scene(folder);
  folder.write("walls.csv", "id,px,py,nx,ny\n3,0,-0.5,0,1\n");
  EXPECT_THAT(read_csv_scene(folder.path()).warnings,
              ::testing::ElementsAre(HasSubstr("0.5, is between disk 10 and wall 3")));
}

struct BadScene {
  const char* name;
  const char* file;
  std::optional<std::string> text;  ///< None: the file is removed.
  std::string message;              ///< After the name of the folder.
};

void PrintTo(const BadScene& scene, std::ostream* stream) { *stream << scene.file; }

class CsvReaderBad : public ::testing::TestWithParam<BadScene> {};

TEST_P(CsvReaderBad, NamesFileLineAndReason) {
  const test::TemporaryFolder folder;
  write_scene(folder);
  if (GetParam().text) {
    folder.write(GetParam().file, *GetParam().text);
  } else {
    std::filesystem::remove(folder / GetParam().file);
  }
  try {
    read_csv_scene(folder.path());
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr(folder.path().string() + "/" + GetParam().message));
  }
}

std::string disks(const std::string& row) { return std::string(kDisks) + "\n" + row + "\n"; }
std::string contacts(const std::string& row) { return std::string(kContacts) + "\n" + row + "\n"; }

const std::vector<BadScene> kBadScenes = {
    {"NanPosition", "disks.csv", disks("1,nan,1,1,2"), "disks.csv:5: x must be a finite number"},
    {"InfinitePosition", "disks.csv", disks("1,3,inf,1,2"), "disks.csv:5: y must be a finite number"},
    {"OverflowingNumber", "disks.csv", disks("1,1e999,1,1,2"), "disks.csv:5: column x: \"1e999\""},
    {"ZeroRadius", "disks.csv", disks("1,3,1,0,2"), "disks.csv:5: radius must be positive, but is 0"},
    {"NegativeMass", "disks.csv", disks("1,3,1,1,-2"), "disks.csv:5: mass must be positive, but is -2"},
    {"NotANumber", "disks.csv", disks("1,3,1,1,heavy"),
     "disks.csv:5: column mass: \"heavy\" is not a number"},
    {"TrailingText", "disks.csv", disks("1,3,1,1,2kg"), "disks.csv:5: column mass: \"2kg\" is not a number"},
    {"EmptyField", "disks.csv", disks("1,3,1,1,"), "disks.csv:5: column mass: the field is empty"},
    {"FractionalId", "disks.csv", disks("1.5,3,1,1,2"), "disks.csv:5: column id: \"1.5\" is not a whole"},
    {"HugeId", "disks.csv", disks("3000000000,3,1,1,2"), "disks.csv:5: column id: 3000000000 does not fit"},
    {"NegativeId", "disks.csv", disks("-1,3,1,1,2"), "disks.csv:5: column id: -1 is negative"},
    {"DoubledId", "disks.csv", disks("10,3,1,1,2"),
     "disks.csv:5: column id: 10 is given twice, first in line 2"},
    {"TooFewFields", "disks.csv", disks("1,3,1,1"), "disks.csv:5: 4 fields, but there are 5 columns"},
    {"TooManyFields", "disks.csv", disks("1,3,1,1,2,5"), "disks.csv:5: 6 fields, but there are 5 columns"},
    {"MissingColumn", "disks.csv", "id,x,y,radius\n1,0,0,1\n", "disks.csv:1: column mass is missing"},
    {"DoubledColumn", "disks.csv", "id,x,y,radius,mass,x\n", "disks.csv:1: column x is given twice"},
    {"UnknownColumn", "disks.csv", "id,x,y,radius,mass,colour\n", "disks.csv:1: column colour is unknown"},
    {"NamelessColumn", "disks.csv", "id,x,y,radius,mass,\n", "disks.csv:1: column 6 has no name"},
    {"NoHeader", "disks.csv", "1,0,1,1,2\n", "disks.csv:1: the first line must name the columns"},
    {"SemicolonsWithoutAColumn", "disks.csv", "id;x;y\n1;2;3\n", "disks.csv:1: column radius is missing"},
    {"Latin1Name", "walls.csv", "id,px,py,nx,ny,name\n3,0,0,0,1,W\xE4nde\n",
     "walls.csv:2: the byte 0xE4 is not UTF-8 text"},
    {"Latin1Scene", "scene.toml", "# na\xEFve\n", "scene.toml:1: the byte 0xEF is not UTF-8 text"},
    {"BehindAWall", "walls.csv", "id,px,py,nx,ny\n3,0,1.5,0,1\n",
     "contacts.csv:3: the centre of disk 10 is behind wall 3: does the normal (0, 1) point into the domain?"},
    {"FarFromAWall", "walls.csv", "id,px,py,nx,ny\n3,0,-27,0,1\n",
     "contacts.csv:3: disk 10 and wall 3 are 27 apart, more than the radius 1: they do not touch"},
    {"FarApart", "disks.csv", "id,x,y,radius,mass\n10,0,1,1,2\n7,5,1,1,2\n", "contacts.csv:2: the normal"},
    {"FarApartWithoutNormals", "contacts.csv", "a,b,mu\n10,-4,0.3\n7,-4,0.3\n",
     "contacts.csv:3: disk 7 and wall 3 are 1.2 apart, more than the radius 1: they do not touch"},
    {"EmptyFile", "disks.csv", "", "disks.csv: the file is empty"},
    {"OnlyComments", "disks.csv", "# nothing\n\n", "disks.csv: the file is empty"},
    {"NoDisk", "disks.csv", "id,x,y,radius,mass\n", "disks.csv: there is no disk in it"},
    {"NoDisksFile", "disks.csv", std::nullopt, "disks.csv: cannot be read (No such file"},
    {"Utf16", "disks.csv", std::string("\xFF\xFEi\0d\0", 6), "disks.csv: is UTF-16 text"},
    {"LongWallNormal", "walls.csv", "id,px,py,nx,ny\n3,0,0,0,2\n",
     "walls.csv:2: the normal (0, 2) must have length 1"},
    {"NanWall", "walls.csv", "id,px,py,nx,ny\n3,nan,0,0,1\n", "walls.csv:2: px must be a finite number"},
    {"DoubledWall", "walls.csv", "id,px,py,nx,ny\n3,0,0,0,1\n3,0,0,1,0\n",
     "walls.csv:3: column id: 3 is given twice"},
    {"NoContactsFile", "contacts.csv", std::nullopt, "contacts.csv: cannot be read (No such file"},
    {"NegativeFriction", "contacts.csv", "a,b,mu\n7,10,-0.1\n",
     "contacts.csv:2: mu must not be negative, but is -0.1"},
    {"NanFriction", "contacts.csv", "a,b,mu\n7,10,nan\n", "contacts.csv:2: mu must be a finite number"},
    {"NoFriction", "contacts.csv", "a,b\n7,10\n", "contacts.csv:2: the friction is not given"},
    {"UnknownDiskA", "contacts.csv", contacts("8,7,,,0.3"), "contacts.csv:5: column a: there is no disk 8"},
    {"UnknownDiskB", "contacts.csv", contacts("7,8,,,0.3"), "contacts.csv:5: column b: there is no disk 8"},
    {"UnknownWall", "contacts.csv", contacts("7,-1,,,0.3"),
     "contacts.csv:5: column b: -1 is wall 0, but there is no such wall"},
    {"Itself", "contacts.csv", contacts("7,7,,,0.3"), "contacts.csv:5: disk 7 cannot touch itself"},
    {"GivenTwice", "contacts.csv", contacts("7,10,,,0.3"),
     "contacts.csv:5: this contact is given twice, first in line 2"},
    {"GivenTwiceReversed", "contacts.csv", contacts("10,7,,,0.3"),
     "contacts.csv:5: this contact is given twice, first in line 2"},
    {"WallWithWall", "contacts.csv", contacts("-4,-4,,,0.3"), "contacts.csv:5: a wall cannot touch a wall"},
    {"WallFirst", "contacts.csv", contacts("-4,7,,,0.3"), "contacts.csv:5: column a: -4 is a wall"},
    {"ShortNormal", "contacts.csv", "a,b,nx,ny,mu\n7,10,0.8,0.5,0.3\n",
     "contacts.csv:2: the normal (0.8, 0.5) must have length 1"},
    {"WrongNormal", "contacts.csv", "a,b,nx,ny,mu\n7,10,-0.8,-0.6,0.3\n",
     "contacts.csv:2: the normal (-0.8, -0.6) disagrees with the positions"},
    {"HalfANormal", "contacts.csv", "a,b,nx,ny,mu\n7,10,1,,0.3\n",
     "contacts.csv:2: nx and ny must both be given"},
    {"InfiniteForce", "contacts.csv", "a,b,mu,R,T\n7,10,0.3,inf,0\n",
     "contacts.csv:2: R and T must be finite or unknown"},
    {"SamePlace", "disks.csv", "id,x,y,radius,mass\n10,0,1,1,2\n7,0,1,1,2\n",
     "contacts.csv:2: the centres of the two disks coincide"},
    {"TomlSyntax", "scene.toml", "gravity = [0,\n", "scene.toml:1: Error while parsing array"},
    {"UnknownKey", "scene.toml", "gravity = [0, -1]\ngravitiy = 3\n", "scene.toml:2: gravitiy is unknown"},
    {"GravityScalar", "scene.toml", "gravity = -1\n", "scene.toml:1: gravity must be a list of two numbers"},
    {"GravityText", "scene.toml", "gravity = [0, \"down\"]\n", "scene.toml:1: gravity must be a number"},
    {"GravityNan", "scene.toml", "gravity = [0, nan]\n", "scene.toml:1: gravity must be finite"},
    {"NegativeForceUnit", "scene.toml", "force_unit = -1\n", "scene.toml:1: force_unit must be positive"},
    {"NegativeDefaultFriction", "scene.toml", "\nmu = -1\n", "scene.toml:2: mu must not be negative"},
};

INSTANTIATE_TEST_SUITE_P(All, CsvReaderBad, ::testing::ValuesIn(kBadScenes),
                         [](const auto& instance) { return std::string(instance.param.name); });

TEST(CsvReader, AFolderIsNeeded) {
  EXPECT_THAT([] { read_csv_scene("/nonexistent/scene"); },
              ::testing::ThrowsMessage<InputError>(HasSubstr("/nonexistent/scene: is not a folder")));
}

}  // namespace
}  // namespace indet
