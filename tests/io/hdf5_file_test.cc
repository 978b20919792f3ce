#include "libindet/io/hdf5_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace indet {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

std::size_t file_count(const test::TemporaryFolder& folder) {
  const std::filesystem::directory_iterator files(folder.path());
  return static_cast<std::size_t>(std::distance(begin(files), end(files)));
}

TEST(Hdf5File, DataComeBack) {
  const test::TemporaryFolder folder;
  const std::vector<double> reals = {1, 2, 3, 4, 5, 6};
  const std::vector<std::int32_t> integers = {-1, 2};
  const std::vector<std::uint8_t> bytes = {0, 2, 1};
  {
    Hdf5File file = Hdf5File::create(folder / "a.h5");
    file.write("/group/deep/reals", reals, {2, 3}, {"m", "lengths"});
    file.write("/group/integers", integers, {2}, {"1", "counts"});
    file.write("/group/bytes", bytes, {3, 1}, {"1", "flags"});
    file.write_enum("/group/colours", bytes, {3}, {"red", "green", "blue"}, {"1", "colours"});
    file.write_strings("/group/names", {"a", "", "ü"}, {"1", "names"});
    file.write("/empty", std::span<const double>(), {0, 4}, {"1", "nothing"});
    file.set_attribute("/group", "text", "Fläche");
    file.set_attribute("/group", "real", 2.5);
    file.set_attribute("/group", "integer", std::int64_t{1} << 40);
    file.set_attribute("/", "vector", std::span<const double>(reals));
    file.commit();
  }
  const Hdf5File file = Hdf5File::open(folder / "a.h5");
  EXPECT_EQ(file.read_doubles("/group/deep/reals", {2, 3}), reals);
  EXPECT_EQ(file.read_integers("/group/integers", {2}), integers);
  EXPECT_EQ(file.read_bytes("/group/bytes", {3, 1}), bytes);
  EXPECT_EQ(file.read_enum("/group/colours", {3}, {"red", "green", "blue"}), bytes);
  EXPECT_THAT(file.read_strings("/group/names", 3), ElementsAre("a", "", "ü"));
  EXPECT_EQ(file.shape("/empty", 2), (Shape{0, 4}));
  EXPECT_THAT(file.read_doubles("/empty", {0, 4}), ElementsAre());
  EXPECT_EQ(file.string_attribute("/group", "text"), "Fläche");
  EXPECT_EQ(file.string_attribute("/group/integers", "unit"), "1");
  EXPECT_EQ(file.double_attribute("/group", "real"), 2.5);
  EXPECT_EQ(file.integer_attribute("/group", "integer"), std::int64_t{1} << 40);
  EXPECT_EQ(file.doubles_attribute("/", "vector", 6), reals);
  EXPECT_THAT(file.datasets("/group"), ElementsAre("/group/bytes", "/group/colours", "/group/deep/reals",
                                                   "/group/integers", "/group/names"));
  EXPECT_THAT(file.number_attributes("/group"),
              ElementsAre(std::pair("integer", 1099511627776.0), std::pair("real", 2.5)));
}

TEST(Hdf5File, LargeDataAreCompressedAndComeBack) {
  const test::TemporaryFolder folder;
  std::vector<double> values(700 * 431);
  std::iota(values.begin(), values.end(), 0.0);
  {
    Hdf5File file = Hdf5File::create(folder / "a.h5");
    file.write("/rows", values, {700, 431}, {"1", "many rows"});
    file.write("/row", values, {1, 700 * 431}, {"1", "one long row"});
    file.commit();
  }
  EXPECT_LT(std::filesystem::file_size(folder / "a.h5"), values.size() * 8);
  const Hdf5File file = Hdf5File::open(folder / "a.h5");
  EXPECT_EQ(file.read_doubles("/rows", {700, 431}), values);
  EXPECT_EQ(file.read_doubles("/row", {1, 700 * 431}), values);
}

TEST(Hdf5File, NothingIsLeftOfAFileThatIsNotCommitted) {
  const test::TemporaryFolder folder;
  {
    Hdf5File file = Hdf5File::create(folder / "a.h5");
    file.make_group("/group");
    EXPECT_EQ(file_count(folder), 1);
    EXPECT_FALSE(std::filesystem::exists(folder / "a.h5"));
  }
  EXPECT_EQ(file_count(folder), 0);
}

TEST(Hdf5File, AnOldFileStaysUntilTheNewOneIsWhole) {
  const test::TemporaryFolder folder;
  folder.write("a.h5", "old");
  Hdf5File file = Hdf5File::create(folder / "a.h5");
  EXPECT_EQ(folder.read("a.h5"), "old");
  file.commit();
  EXPECT_EQ(file_count(folder), 1);
  EXPECT_NO_THROW(Hdf5File::open(folder / "a.h5"));
}

TEST(Hdf5File, PlacesThatCannotBeWrittenAreNamed) {
  const test::TemporaryFolder folder;
  EXPECT_THAT([&] { Hdf5File::create(folder / "no" / "a.h5"); },
              ThrowsMessage<InputError>(HasSubstr("does not exist")));
  EXPECT_THAT([&] { Hdf5File::create(folder.path()); }, ThrowsMessage<InputError>(HasSubstr("is a folder")));
  EXPECT_THAT([&] { Hdf5File::create("/proc/a.h5"); },
              ThrowsMessage<InputError>(HasSubstr("cannot be written")));
}

TEST(Hdf5File, WrongCountsAreCaughtWhenWriting) {
  const test::TemporaryFolder folder;
  Hdf5File file = Hdf5File::create(folder / "a.h5");
  const std::vector<double> values(5);
  EXPECT_THAT(
      [&] {
        file.write("/a", values, {2, 3}, {"1", "a"});
      },
      ThrowsMessage<Hdf5WriteError>(HasSubstr("5 values do not fill the shape [2, 3]")));
}

class Hdf5FileReading : public ::testing::Test {
 protected:
  Hdf5FileReading() {
    Hdf5File file = Hdf5File::create(folder_ / "a.h5");
    const std::vector<double> reals(6);
    const std::vector<std::int32_t> integers(3);
    file.write("/reals", reals, {2, 3}, {"1", "reals"});
    file.write("/integers", integers, {3}, {"1", "integers"});
    file.write_enum("/enum", std::vector<std::uint8_t>{0, 1}, {2}, {"a", "b"}, {"1", "enum"});
    file.commit();
  }

  template <class Action>
  void expect_error(Action action, const std::string& message) const {
    const Hdf5File file = Hdf5File::open(folder_ / "a.h5");
    EXPECT_THAT([&] { action(file); }, ThrowsMessage<Hdf5ReadError>(HasSubstr(message)));
  }

  test::TemporaryFolder folder_;
};

TEST_F(Hdf5FileReading, UnexpectedObjectsAreNamed) {
  expect_error([](const Hdf5File& f) { f.read_doubles("/none", {1}); }, "/none: is missing");
  expect_error([](const Hdf5File& f) { f.read_doubles("/", {1}); }, "/: is not a dataset");
  expect_error([](const Hdf5File& f) { f.read_doubles("/integers", {3}); },
               "must hold floating-point numbers");
  expect_error([](const Hdf5File& f) { f.read_integers("/reals", {2, 3}); }, "must hold integers");
  expect_error([](const Hdf5File& f) { f.read_bytes("/integers", {3}); }, "must hold integers of 8 bits");
  expect_error([](const Hdf5File& f) { f.read_doubles("/reals", {3, 2}); }, "shape [2, 3] instead of [3, 2]");
  expect_error([](const Hdf5File& f) { f.shape("/reals", 1); }, "rank 2 instead of 1");
  expect_error([](const Hdf5File& f) { f.read_enum("/enum", {2}, {"b", "a"}); }, "must be an enumeration");
  expect_error([](const Hdf5File& f) { f.double_attribute("/reals", "none"); }, "/reals@none: is missing");
  expect_error([](const Hdf5File& f) { f.double_attribute("/reals", "unit"); }, "must be a number");
}

TEST_F(Hdf5FileReading, FilesThatAreNotHdf5AreRefused) {
  folder_.write("text.h5", "not a file of this kind");
  EXPECT_THAT([&] { Hdf5File::open(folder_ / "text.h5"); },
              ThrowsMessage<Hdf5ReadError>(HasSubstr("cannot be opened as an HDF5 file")));
  EXPECT_THAT([&] { Hdf5File::open(folder_ / "none.h5"); },
              ThrowsMessage<Hdf5ReadError>(HasSubstr("no such file")));
  EXPECT_THAT([&] { Hdf5File::open(folder_.path()); },
              ThrowsMessage<Hdf5ReadError>(HasSubstr("is not a file")));
}

TEST_F(Hdf5FileReading, TruncatedFilesAreRefused) {
  const auto size = std::filesystem::file_size(folder_ / "a.h5");
  std::filesystem::resize_file(folder_ / "a.h5", size / 2);
  EXPECT_THROW(Hdf5File::open(folder_ / "a.h5"), Hdf5ReadError);
}

TEST(Hdf5File, DamagedDataAreCaughtByTheirChecksum) {
  const test::TemporaryFolder folder;
  std::vector<double> values(20000);
  std::iota(values.begin(), values.end(), 0.5);
  {
    Hdf5File file = Hdf5File::create(folder / "a.h5");
    file.write("/values", values, {20000}, {"1", "values"});
    file.commit();
  }
  std::string bytes = folder.read("a.h5");
  bytes[bytes.size() - 500] ^= 1;  // the data are at the end
  folder.write("a.h5", bytes);
  const Hdf5File file = Hdf5File::open(folder / "a.h5");
  EXPECT_THROW(file.read_doubles("/values", {20000}), Hdf5ReadError);
}

TEST(Hdf5File, DigestSeesEveryNumberAndNoStorage) {
  const test::TemporaryFolder folder;
  const auto digest = [&](double last, std::int64_t attribute, const Shape& shape) {
    Hdf5File file = Hdf5File::create(folder / "a.h5");
    const std::vector<double> values = {1, 2, 3, 4, 5, last};
    file.write("/group/values", values, shape, {"1", "values"});
    file.set_attribute("/group", "count", attribute);
    file.set_attribute("/group", "text", "no number");
    return file.sha256({"/group"});
  };
  const std::string reference = digest(6, 7, {2, 3});
  EXPECT_EQ(reference.size(), 64);
  EXPECT_EQ(digest(6, 7, {2, 3}), reference);
  EXPECT_NE(digest(6.000000000000001, 7, {2, 3}), reference);
  EXPECT_NE(digest(6, 8, {2, 3}), reference);
  EXPECT_NE(digest(6, 7, {3, 2}), reference);
}

}  // namespace
}  // namespace indet
