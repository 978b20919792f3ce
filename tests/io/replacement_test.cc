#include "libindet/io/replacement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <string>

#include "libindet/base/error.h"
#include "libindet/io/packing_file.h"
#include "libindet/io/picture_mark.h"
#include "libindet/io/whole_file.h"
#include "tests/io/sample.h"
#include "tests/support/temporary_folder.h"

namespace indet {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// A rule that takes every file that is there for one of this kind.
Replacement rule(std::optional<FileKind> found, bool overwrite, std::vector<fs::path> inputs = {}) {
  return {std::move(inputs), overwrite, [found](const fs::path&) { return found; }};
}

TEST(Replacement, DependsOnTheKindOfWhatIsThere) {
  const test::TemporaryFolder folder;
  folder.write("a", "text");
  EXPECT_NO_THROW(rule(FileKind::kRanges, false).require(folder / "a", FileKind::kRanges));
  EXPECT_THAT([&] { rule(FileKind::kPacking, false).require(folder / "a", FileKind::kRanges); },
              ThrowsMessage<InputError>(HasSubstr("holds a packing, and would be replaced by force ranges")));
  EXPECT_THAT([&] { rule({}, false).require(folder / "a", FileKind::kRanges); },
              ThrowsMessage<InputError>(HasSubstr("not a file that indet wrote whole")));
  EXPECT_NO_THROW(rule(FileKind::kPacking, true).require(folder / "a", FileKind::kRanges));
  EXPECT_NO_THROW(rule({}, true).require(folder / "a", FileKind::kRanges));
}

TEST(Replacement, NothingIsLostOfWhatIsEmptyOrNotThere) {
  const test::TemporaryFolder folder;
  folder.write("empty", "");
  EXPECT_NO_THROW(rule({}, false).require(folder / "empty", FileKind::kRanges));
  EXPECT_NO_THROW(rule({}, false).require(folder / "none", FileKind::kRanges));
  EXPECT_NO_THROW(rule({}, false).require("/dev/null", FileKind::kRanges));
}

TEST(Replacement, WhatIsReadStaysUnderEveryName) {
  const test::TemporaryFolder folder;
  folder.write("a", "text");
  fs::create_symlink("a", folder / "symbolic");
  fs::create_hard_link(folder / "a", folder / "hard");
  for (const char* name : {"a", "symbolic", "hard", "./a"}) {
    EXPECT_THAT(
        [&] { rule(FileKind::kRanges, true, {folder / "a"}).require(folder / name, FileKind::kRanges); },
        ThrowsMessage<InputError>(HasSubstr("choose another name for the output")))
        << name;
  }
  EXPECT_NO_THROW(rule({}, true, {folder / "b"}).require(folder / "a", FileKind::kRanges));
}

TEST(Replacement, AFolderIsFilledIfItIsOfThisRun) {
  const test::TemporaryFolder folder;
  const fs::path figures = folder / "figures";
  EXPECT_NO_THROW(rule({}, false).require_folder(figures, "mark"));
  fs::create_directory(figures);
  EXPECT_NO_THROW(rule({}, false).require_folder(figures, "mark"));
  write_whole_file(figures / "other", "text");
  EXPECT_THAT([&] { rule({}, false).require_folder(figures, "mark"); },
              ThrowsMessage<InputError>(HasSubstr("did not make")));
  EXPECT_NO_THROW(rule({}, true).require_folder(figures, "mark"));
  write_whole_file(figures / "mark", "text");
  EXPECT_NO_THROW(rule({}, false).require_folder(figures, "mark"));
}

TEST(FileKind, IsKnownByTheContents) {
  const test::TemporaryFolder folder;
  const auto kind_of_text = [&](const std::string& text) {
    folder.write("a", text);
    return recognise(folder / "a");
  };
  write_packing(folder / "p.h5", test::sample_packing(), {});
  EXPECT_EQ(recognise(folder / "p.h5"), FileKind::kPacking);
  EXPECT_EQ(kind_of_text(folder.read("p.h5").substr(0, 2000)), std::nullopt);
  EXPECT_EQ(kind_of_text("a,b,nx,ny,mu,R,T,gap\n"), FileKind::kCsvScene);
  EXPECT_EQ(kind_of_text("a,b,nx,ny,mu\n"), std::nullopt);
  EXPECT_EQ(kind_of_text("gravity = [0, -1]\n"), FileKind::kCsvScene);
  EXPECT_EQ(kind_of_text("gravity = [0, -1]\nforce_unit = 2\n"), FileKind::kCsvScene);
  EXPECT_EQ(kind_of_text("gravity = [0, -1]\nforce_unit = 2\n# mine\n"), std::nullopt);
  EXPECT_EQ(kind_of_text("gravity = [0, -1]\nmu = 0.3\n"), std::nullopt);
  EXPECT_EQ(kind_of_text(mark_svg("<?xml version=\"1.0\"?>\n<svg/>\n")), FileKind::kPicture);
  EXPECT_EQ(kind_of_text("<?xml version=\"1.0\"?>\n<svg/>\n"), std::nullopt);
  EXPECT_EQ(kind_of_text(""), std::nullopt);
}

TEST(WholeFile, FollowsLinksAndLeavesThem) {
  const test::TemporaryFolder folder;
  fs::create_directory(folder / "sub");
  fs::create_symlink("sub/b", folder / "a");
  for (const char* text : {"one", "two"}) {
    write_whole_file(folder / "a", text);
    EXPECT_TRUE(fs::is_symlink(folder / "a"));
    EXPECT_EQ(folder.read("sub/b"), text);
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / "sub"), fs::directory_iterator()), 1);
}

TEST(WholeFile, LeavesNothingUnlessCommitted) {
  const test::TemporaryFolder folder;
  { const WholeFile file(folder / "a"); }
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

}  // namespace
}  // namespace indet
