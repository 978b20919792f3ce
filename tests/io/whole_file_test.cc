#include "libindet/io/whole_file.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <string>

#include "libindet/base/error.h"
#include "libindet/io/hdf5_file.h"
#include "tests/support/temporary_folder.h"

namespace indet {
namespace {

namespace fs = std::filesystem;

/// The name under which a process that has ended would have written.
fs::path name_of_dead_writer(const fs::path& path) {
  const pid_t child = fork();
  if (child == 0) _exit(0);
  waitpid(child, nullptr, 0);
  std::string name = temporary_name(path).string();
  const std::string own = "." + std::to_string(getpid()) + ".";
  name.replace(name.rfind(own), own.size(), "." + std::to_string(child) + ".");
  return name;
}

void make_old(const fs::path& path, std::chrono::hours age) {
  fs::last_write_time(path, fs::file_time_type::clock::now() - age);
}

TEST(WholeFile, LeftoversOfTheDeadGo) {
  const test::TemporaryFolder folder;
  const fs::path leftover = name_of_dead_writer(folder / "m.h5").filename();
  folder.write(leftover.string(), "half");
  remove_leftovers(folder.path());
  EXPECT_FALSE(fs::exists(folder.path() / leftover));
}

TEST(WholeFile, FilesOfWritersAtWorkStay) {
  const test::TemporaryFolder folder;
  const Hdf5File unfinished = Hdf5File::create(folder / "m.h5");
  const std::string mine = temporary_name(folder / "m.h5").filename().string();
  folder.write(mine, "half");
  folder.write(".m.h5.other-host.1.0.tmp", "half");
  remove_leftovers(folder.path());
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 3);
}

TEST(WholeFile, LeftoversOfOtherHostsGoAfterADay) {
  const test::TemporaryFolder folder;
  for (const char* name : {".m.h5.other-host.1.0.tmp", ".n.h5.other-host.1.0.tmp"})
    folder.write(name, "half");
  make_old(folder / ".m.h5.other-host.1.0.tmp", std::chrono::hours(25));
  make_old(folder / ".n.h5.other-host.1.0.tmp", std::chrono::hours(23));
  remove_leftovers(folder.path());
  EXPECT_FALSE(fs::exists(folder / ".m.h5.other-host.1.0.tmp"));
  EXPECT_TRUE(fs::exists(folder / ".n.h5.other-host.1.0.tmp"));
}

TEST(WholeFile, NoOtherFileIsTakenForALeftover) {
  const test::TemporaryFolder folder;
  const auto names = {"m.h5",
                      ".bashrc",
                      ".tmp",
                      "..tmp",
                      ".0.tmp",
                      ".1.0.tmp",
                      ".host.1.0.tmp",
                      "m.h5.host.1.0.tmp",
                      ".m.host.x.0.tmp",
                      ".m.host.1..tmp",
                      ".m.host.1.0.h5"};
  for (const char* name : names) {
    folder.write(name, "");
    make_old(folder / name, std::chrono::hours(1000));
  }
  remove_leftovers(folder.path());
  for (const char* name : names) EXPECT_TRUE(fs::exists(folder / name)) << name;
}

TEST(WholeFile, NothingTakesItsNameWithoutPermission) {
  const test::TemporaryFolder folder;
  write_whole_file(folder / "old", "old");
  ask_before_writing([] { return false; });
  EXPECT_THROW(write_whole_file(folder / "new", "new"), Interrupted);
  EXPECT_THROW(link_whole_file(folder / "old", folder / "linked"), Interrupted);
  ask_before_writing([] { return true; });
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1);
  link_whole_file(folder / "old", folder / "linked");
  EXPECT_EQ(folder.read("linked"), "old");
}

TEST(WholeFile, FilesThatBelongTogetherComeTogether) {
  const test::TemporaryFolder folder;
  EXPECT_THROW(write_whole_files({{folder / "a", "a"}, {folder / "missing" / "b", "b"}}), InputError);
  EXPECT_TRUE(fs::is_empty(folder.path()));
  write_whole_files({{folder / "a", "a"}, {folder / "b", "b"}});
  EXPECT_EQ(folder.read("a") + folder.read("b"), "ab");
}

TEST(WholeFile, AProgramThatEndsAtOnceLeavesNothingUnfinished) {
  const test::TemporaryFolder folder;
  const pid_t child = fork();
  if (child == 0) {
    const WholeFile file(folder / "a");
    if (fs::is_empty(folder.path())) _exit(1);
    abandon_files();
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(WholeFile, NamesMayBeAsLongAsTheFileSystemAllows) {
  const test::TemporaryFolder folder;
  const std::string name(255, 'n');
  write_whole_file(folder / name, "whole");
  EXPECT_EQ(folder.read(name), "whole");
}

}  // namespace
}  // namespace indet
