#include "libindet/io/lammps_reader.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <ostream>
#include <sstream>
#include <string>
#include <vector>

#include "libindet/base/error.h"
#include "libindet/base/random.h"
#include "libindet/io/balance.h"
#include "tests/support/temporary_folder.h"

namespace indet {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;

const std::string kData = std::string(INDET_TEST_DATA) + "/lammps/";

struct LammpsOptions {
  DumpFiles files;
  ImportSettings settings;
};

ImportedPacking read_lammps(const LammpsOptions& options) {
  return indet::read_lammps(options.files, options.settings);
}

LammpsOptions real_options() {
  return {{kData + "atoms.dump", kData + "contacts.dump", {}}, {.friction = FrictionRule(0.3)}};
}

TEST(LammpsReader, ReadsARealPackingInEquilibrium) {
  const ImportedPacking imported = read_lammps(real_options());
  EXPECT_EQ(imported.packing.disk_count(), 220);
  EXPECT_EQ(imported.packing.contact_count(), 376);
  EXPECT_EQ(imported.packing.wall_count(), 3);
  EXPECT_THAT(imported.warnings, IsEmpty());
  EXPECT_EQ(imported.rounding, 0);
  const BalanceReport report = report_balance(imported);
  EXPECT_TRUE(report.forces_known);
  EXPECT_LT(report.force_residual, 2e-11);
  EXPECT_GT(report.force_residual, 1e-12);  // MD with damping does not come to rest exactly
  EXPECT_LT(report.torque_residual, 1e-14);
  EXPECT_EQ(report.coulomb_violations, 0);
  EXPECT_EQ(report.duplicates, 0);
  EXPECT_EQ(report.loose_disks, 0);
  EXPECT_NO_THROW(require_balance(imported, report, default_balance_tolerance(imported)));
}

TEST(LammpsReader, WallsAreNamedByTheirFixes) {
  const Packing packing = read_lammps(real_options()).packing;
  std::vector<std::string> names;
  for (const Wall& wall : packing.walls) {
    names.push_back(fmt::format("{} ({}, {}) · x = {}", wall.name, wall.normal.x(), wall.normal.y(),
                                wall.normal.dot(wall.point)));
  }
  EXPECT_THAT(names,
              ::testing::ElementsAre("wr (-1, 0) · x = -12", "wx (1, 0) · x = 0", "wy (0, 1) · x = 0"));
}

/// A dump as text, so that tests can change it: head lines, column names, rows.
struct Dump {
  std::vector<std::string> head;
  std::string label;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;

  std::string text() const {
    std::string text;
    for (const std::string& line : head) text += line + "\n";
    text += label;
    for (const std::string& column : columns) text += " " + column;
    text += "\n";
    for (const auto& row : rows) {
      for (const std::string& field : row) text += field + " ";
      text += "\n";
    }
    return text;
  }

  std::size_t column(const std::string& name) const {
    return static_cast<std::size_t>(std::find(columns.begin(), columns.end(), name) - columns.begin());
  }
};

Dump read_dump(const std::string& path) {
  std::ifstream stream(path);
  Dump dump;
  std::string line;
  while (std::getline(stream, line)) {
    std::istringstream words(line);
    std::vector<std::string> fields;
    for (std::string word; words >> word;) fields.push_back(word);
    if (!dump.columns.empty()) {
      dump.rows.push_back(fields);
    } else if (fields.size() > 6) {
      dump.label = fields[0] + " " + fields[1];
      dump.columns.assign(fields.begin() + 2, fields.end());
    } else {
      dump.head.push_back(line);
    }
  }
  return dump;
}

template <class T>
void shuffle(std::vector<T>& items, Random& random) {
  for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[random.below(i)]);
}

void shuffle_columns(Dump& dump, Random& random) {
  std::vector<std::size_t> order(dump.columns.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  shuffle(order, random);
  Dump shuffled = dump;
  for (std::size_t i = 0; i < order.size(); ++i) {
    shuffled.columns[i] = dump.columns[order[i]];
    for (std::size_t row = 0; row < dump.rows.size(); ++row) shuffled.rows[row][i] = dump.rows[row][order[i]];
  }
  dump = shuffled;
}

struct Dumps {
  Dump atoms = read_dump(kData + "atoms.dump");
  Dump contacts = read_dump(kData + "contacts.dump");

  ImportedPacking read(const LammpsOptions& changed = real_options()) const {
    const test::TemporaryFolder folder;
    folder.write("atoms.dump", atoms.text());
    folder.write("contacts.dump", contacts.text());
    LammpsOptions options = changed;
    options.files.atoms = folder / "atoms.dump";
    options.files.contacts = folder / "contacts.dump";
    return read_lammps(options);
  }
};

void expect_same(const Packing& left, const Packing& right) {
  ASSERT_EQ(left.disk_count(), right.disk_count());
  ASSERT_EQ(left.contact_count(), right.contact_count());
  for (int i = 0; i < left.disk_count(); ++i) {
    EXPECT_EQ(left[DiskId(i)].id, right[DiskId(i)].id);
    EXPECT_EQ(left[DiskId(i)].position, right[DiskId(i)].position);
  }
  for (int i = 0; i < left.contact_count(); ++i) {
    const Contact& a = left[ContactId(i)];
    const Contact& b = right[ContactId(i)];
    EXPECT_TRUE(a.a == b.a && a.b == b.b && a.normal == b.normal && a.R == b.R && a.T == b.T) << i;
  }
}

TEST(LammpsReader, OrderOfRowsAndColumnsDoesNotMatter) {
  Dumps dumps;
  Random random(1);
  shuffle(dumps.atoms.rows, random);
  shuffle(dumps.contacts.rows, random);
  shuffle_columns(dumps.atoms, random);
  shuffle_columns(dumps.contacts, random);
  expect_same(dumps.read().packing, read_lammps(real_options()).packing);
}

TEST(LammpsReader, OtherNamesOfColumnsCanBeMapped) {
  Dumps dumps;
  dumps.atoms.columns[dumps.atoms.column("radius")] = "c_r";
  dumps.contacts.columns[dumps.contacts.column("c_pl[3]")] = "c_force[1]";
  for (int i = 1; i <= 8; ++i) {
    dumps.atoms.columns[dumps.atoms.column(fmt::format("f_wy[{}]", i))] = fmt::format("c_ground[{}]", i);
  }
  LammpsOptions options = real_options();
  options.settings.columns = {{"radius", "c_r"},
                              {"fx", "c_force[1]"},
                              {"wall:floor", "c_ground"},
                              {"wall:left", "f_wx"},
                              {"wall:right", "f_wr"}};
  const Packing packing = dumps.read(options).packing;
  EXPECT_EQ(packing.contact_count(), 376);
  EXPECT_EQ(packing.walls[0].name, "floor");
  options.settings.columns["speed"] = "v";
  EXPECT_THAT([&] { dumps.read(options); }, ThrowsMessage<InputError>(HasSubstr("speed is unknown")));
}

TEST(LammpsReader, SixDigitsAreAcceptedWithAWarning) {
  Dumps dumps;
  for (Dump* dump : {&dumps.atoms, &dumps.contacts}) {
    for (auto& row : dump->rows) {
      for (auto& field : row) {
        if (field.find_first_of(".e") != std::string::npos) field = fmt::format("{:.6g}", std::stod(field));
      }
    }
  }
  const ImportedPacking imported = dumps.read();
  EXPECT_THAT(imported.warnings, Contains(HasSubstr("dump_modify ID format float %.17g")));
  const BalanceReport report = report_balance(imported);
  EXPECT_GT(report.force_residual, 1e-6);
  const double allowed = default_balance_tolerance(imported);
  EXPECT_LT(allowed, 0.2);
  EXPECT_NO_THROW(require_balance(imported, report, allowed));
  EXPECT_THAT([&] { require_balance(imported, report, 1e-6); },
              ThrowsMessage<InputError>(HasSubstr("raise --balance-tol")));
}

TEST(LammpsReader, TheLastFrameIsReadUnlessATimestepIsGiven) {
  const test::TemporaryFolder folder;
  Dumps late;
  Dumps early;
  for (Dump* dump : {&early.atoms, &early.contacts}) dump->head[1] = "500000";
  early.atoms.rows[0][early.atoms.column("mass")] = "99";
  folder.write("atoms.dump", early.atoms.text() + late.atoms.text());
  folder.write("contacts.dump", early.contacts.text() + late.contacts.text());
  LammpsOptions options = real_options();
  options.files.atoms = folder / "atoms.dump";
  options.files.contacts = folder / "contacts.dump";
  EXPECT_NE(read_lammps(options).packing.disks[0].mass, 99);
  options.files.timestep = 500000;
  EXPECT_EQ(read_lammps(options).packing.disks[0].mass, 99);
  options.files.timestep = 7;
  EXPECT_THAT([&] { read_lammps(options); },
              ThrowsMessage<InputError>(HasSubstr(
                  "there is no frame of timestep 7; the file has 2 frames, of timesteps 500000 … 600000")));
}

TEST(LammpsReader, EqualDuplicatesAreTakenOnce) {
  Dumps dumps;
  dumps.contacts.rows.push_back(dumps.contacts.rows[5]);
  // The same contact seen from the other atom: exchanged atoms, opposite forces.
  auto reversed = dumps.contacts.rows[7];
  std::swap(reversed[1], reversed[2]);
  for (std::size_t i = 5; i <= 8; ++i) {
    reversed[i] = reversed[i].starts_with('-') ? reversed[i].substr(1) : "-" + reversed[i];
  }
  dumps.contacts.rows.push_back(reversed);
  dumps.contacts.head[3] = "344";
  const ImportedPacking imported = dumps.read();
  EXPECT_EQ(imported.packing.contact_count(), 376);
  EXPECT_EQ(imported.duplicates, 2);
  EXPECT_EQ(report_balance(imported).duplicates, 2);
  EXPECT_THAT(imported.warnings, Contains(HasSubstr("2 contacts are given twice")));
}

TEST(LammpsReader, PairsThatNeitherTouchNorPushAreLeftOut) {
  Dumps dumps;
  dumps.contacts.rows.push_back({"343", "1", "220", "9", "0", "0", "0", "0", "0", "0"});
  dumps.contacts.head[3] = "343";
  const ImportedPacking imported = dumps.read();
  EXPECT_EQ(imported.packing.contact_count(), 376);
  EXPECT_THAT(imported.warnings, Contains(HasSubstr("left out 1 pair of atoms, which neither touch")));
}

TEST(LammpsReader, AtomsBehindAWallAreReported) {
  Dumps dumps;
  dumps.atoms.rows[219][dumps.atoms.column("y")] = "31";
  std::erase_if(dumps.contacts.rows, [](const auto& row) { return row[1] == "220" || row[2] == "220"; });
  dumps.contacts.head[3] = std::to_string(dumps.contacts.rows.size());
  const ImportedPacking imported = dumps.read();
  EXPECT_THAT(imported.warnings,
              Contains(HasSubstr("1 atom is outside the box or behind a wall; the first is atom 220")));
  const BalanceReport report = report_balance(imported);
  EXPECT_EQ(report.loose_disks, 1);
  EXPECT_EQ(imported.packing[report.first_loose].id, 220);
  EXPECT_THAT([&] { require_balance(imported, report, 1e-6); },
              ThrowsMessage<InputError>(HasSubstr("the forces do not balance")));
}

TEST(LammpsReader, ForcesOfAnotherKindAreSuspect) {
  LammpsOptions options = real_options();
  options.settings.columns = {{"fx", "c_pl[5]"}, {"fy", "c_pl[6]"}, {"p1", "c_pl[3]"}, {"p2", "c_pl[4]"}};
  const ImportedPacking imported = Dumps().read(options);
  EXPECT_THAT(imported.warnings, Contains(HasSubstr("are the columns the right ones?")));
}

struct BadDump {
  const char* name;
  std::function<void(Dumps&)> spoil;
  std::string message;
};

void PrintTo(const BadDump& dump, std::ostream* stream) { *stream << dump.name; }

class LammpsReaderBad : public ::testing::TestWithParam<BadDump> {};

TEST_P(LammpsReaderBad, NamesFileLineAndReason) {
  Dumps dumps;
  GetParam().spoil(dumps);
  EXPECT_THAT([&] { dumps.read(); }, ThrowsMessage<InputError>(HasSubstr(GetParam().message)));
}

void set_atom(Dumps& dumps, std::size_t row, const std::string& column, const std::string& value) {
  dumps.atoms.rows[row][dumps.atoms.column(column)] = value;
}
void set_contact(Dumps& dumps, std::size_t row, const std::string& column, const std::string& value) {
  dumps.contacts.rows[row][dumps.contacts.column(column)] = value;
}

const std::vector<BadDump> kBadDumps = {
    {"Truncated", [](Dumps& d) { d.atoms.rows.resize(100); },
     "atoms.dump: the frame of timestep 600000 has only 100 of its 220 rows; the file is truncated"},
    {"TruncatedRow", [](Dumps& d) { d.contacts.rows.back().resize(4); }, "contacts.dump:351: 4 fields, but"},
    {"TooManyRows", [](Dumps& d) { d.contacts.head[3] = "300"; },
     "contacts.dump:310: more rows than the 300"},
    {"OtherTimestep", [](Dumps& d) { d.contacts.head[1] = "500000"; }, "with 500000; choose a timestep"},
    {"NoDump", [](Dumps& d) { d.atoms.head[0] = "id,x,y"; }, "atoms.dump:1: this is not a LAMMPS text dump"},
    {"Empty",
     [](Dumps& d) {
       d.atoms = {};
       d.atoms.head = {""};
     },
     "atoms.dump: the file is empty"},
    {"MissingColumn", [](Dumps& d) { d.atoms.columns[d.atoms.column("radius")] = "r"; },
     "atoms.dump:9: column radius is missing"},
    {"MissingWallColumn", [](Dumps& d) { d.atoms.columns[d.atoms.column("f_wy[3]")] = "a"; },
     "atoms.dump:9: column f_wy[3] is missing"},
    {"MissingForce", [](Dumps& d) { d.contacts.columns[d.contacts.column("c_pl[5]")] = "a"; },
     "contacts.dump:9: column c_pl[5] is missing"},
    {"DoubledColumn", [](Dumps& d) { d.atoms.columns[d.atoms.column("vx")] = "x"; },
     "atoms.dump:9: column x is given twice"},
    {"NotANumber", [](Dumps& d) { set_atom(d, 2, "x", "here"); }, "atoms.dump:12: column x: \"here\""},
    {"NanPosition", [](Dumps& d) { set_atom(d, 2, "x", "nan"); }, "atoms.dump:12: x must be a finite number"},
    {"ZeroRadius", [](Dumps& d) { set_atom(d, 2, "radius", "0"); }, "atoms.dump:12: radius must be positive"},
    {"NegativeMass", [](Dumps& d) { set_atom(d, 2, "mass", "-1"); }, "atoms.dump:12: mass must be positive"},
    {"DoubledAtom", [](Dumps& d) { set_atom(d, 2, "id", "1"); }, "atoms.dump:12: atom 1 is given twice"},
    {"UnknownAtom", [](Dumps& d) { set_contact(d, 3, "c_pp[2]", "999"); },
     "contacts.dump:13: atom 999 is not in"},
    {"Itself", [](Dumps& d) { set_contact(d, 3, "c_pp[2]", "3"); },
     "contacts.dump:13: atom 3 cannot touch itself"},
    {"FarApart", [](Dumps& d) { set_contact(d, 3, "c_pp[2]", "220"); },
     "contacts.dump:13: atoms 3 and 220 push each other, but"},
    {"OtherForces",
     [](Dumps& d) {
       set_contact(d, 1, "c_pp[1]", "1");
       set_contact(d, 1, "c_pp[2]", "13");
     },
     "contacts.dump:11: the contact of atoms 1 and 13 is given twice, first in line 10, with another force"},
    {"NanForce", [](Dumps& d) { set_contact(d, 3, "c_pl[3]", "inf"); },
     "contacts.dump:13: the force of atoms 3 and 15 is not a finite number"},
    {"OutOfPlane", [](Dumps& d) { set_atom(d, 0, "f_wy[4]", "1"); },
     "atoms.dump:10: wall wy pushes atom 1 along z"},
    {"CurvedWall", [](Dumps& d) { set_atom(d, 1, "f_wy[5]", "2.4"); },
     "atoms.dump:11: wall wy is not made of planes that stand still"},
};

INSTANTIATE_TEST_SUITE_P(All, LammpsReaderBad, ::testing::ValuesIn(kBadDumps),
                         [](const auto& instance) { return std::string(instance.param.name); });

TEST(LammpsReader, FrictionMustBeGiven) {
  LammpsOptions options = real_options();
  options.settings.friction = {};
  EXPECT_THAT(
      [&] { read_lammps(options); },
      ThrowsMessage<InputError>(HasSubstr("contacts.dump:10: the friction of atoms 1 and 13 is not known")));
  options.settings.friction = FrictionRule::parse({"disk=0.3"});
  EXPECT_THAT([&] { read_lammps(options); },
              ThrowsMessage<InputError>(HasSubstr("--friction MU or wall=MU")));
}

}  // namespace
}  // namespace indet
