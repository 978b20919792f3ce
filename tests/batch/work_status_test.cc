#include "apps/batch/work_status.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>

#include "libindet/io/whole_file.h"

namespace indet {
namespace {

namespace fs = std::filesystem;
using Item = WorkStatus::Item;
using testing::ElementsAre;

class WorkStatusTest : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(results());
    fs::create_directories(tasks_folder(folder_));
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path results() const { return folder_ / "members"; }
  void result(const std::string& name) const { std::ofstream(results() / (name + ".h5")) << "whole"; }

  fs::path record(const std::string& name, TaskRecord record) const {
    record.work = record.work.empty() ? "digest" : record.work;
    const fs::path path = tasks_folder(folder_) / (name + ".json");
    write_task_record(path, record);
    return path;
  }

  WorkStatus status(std::vector<WorkItem> items) const {
    return status_of(folder_, {.digest = "digest",
                               .items = std::move(items),
                               .results = results(),
                               .is_done = [](std::size_t) { return true; }});
  }

  fs::path folder_ = fs::temp_directory_path() / ("work-status-" + std::to_string(getpid()));
};

TaskRecord running_here(const std::string& item) {
  TaskRecord record;
  record.host = host_in_names();
  record.process = getpid();
  record.threads = 2;
  record.in_hand = {{item, 0}};
  return record;
}

TEST_F(WorkStatusTest, OfAnEmptyFolderAllIsMissing) {
  fs::remove_all(folder_);
  const WorkStatus found = status({{"a", 1}, {"b", 3}});
  EXPECT_THAT(found.items, ElementsAre(Item::kMissing, Item::kMissing));
  EXPECT_EQ(found.starts, 0);
  EXPECT_EQ(found.left, 4);
  EXPECT_EQ(found.longest, 3);
  EXPECT_EQ(found.seconds_on(1, 1), 4);
  EXPECT_EQ(found.seconds_on(2, 4), 3);  // no less than the dearest item
}

TEST_F(WorkStatusTest, CountsWhatRecordsAndFilesTell) {
  TaskRecord other = running_here("e");
  other.host = "elsewhere";
  TaskRecord ended;
  ended.state = "failed";
  ended.done = {{"a", {{"simulate", 3}, {"analyze", 1}}}, {"gone", {{"simulate", 9}}}};
  ended.failures = {{"d", "does not settle"}};
  record("1", ended);
  record("2", running_here("c"));
  record("3", other);
  result("a");
  result("b");  // no record tells of it
  const WorkStatus found = status({{"a", 2}, {"b", 2}, {"c", 2}, {"d", 2}, {"e", 2}, {"gone", 2}});
  EXPECT_THAT(found.items, ElementsAre(Item::kDone, Item::kDone, Item::kRunning, Item::kFailed,
                                       Item::kRunning, Item::kMissing));
  ASSERT_EQ(found.failures.size(), 1);
  EXPECT_EQ(found.failures[0].reason, "does not settle");
  EXPECT_EQ(found.starts, 3);
  EXPECT_EQ(found.seconds.at("analyze"), 1);
  EXPECT_NEAR(found.pace, (4 + 9) / 4.0, 1e-12);
  EXPECT_NEAR(found.left, 4 * 2 * found.pace, 1e-12);
}

TEST_F(WorkStatusTest, WorkOfTheDeadIsStaleUntilAnotherHasIt) {
  TaskRecord dead = running_here("a");
  dead.process = 999'999'999;  // there is no such one
  dead.in_hand.push_back({"b", 0});
  record("1", dead);
  const fs::path silent = [&] {
    TaskRecord elsewhere = running_here("c");
    elsewhere.host = "elsewhere";
    return record("0", elsewhere);
  }();
  fs::last_write_time(silent, fs::file_time_type::clock::now() - std::chrono::minutes(10));
  record("2", running_here("b"));
  const WorkStatus found = status({{"a", 1}, {"b", 1}, {"c", 1}});
  EXPECT_THAT(found.items, ElementsAre(Item::kStale, Item::kRunning, Item::kStale));
  EXPECT_EQ(found.tasks.size(), 3);
}

TEST_F(WorkStatusTest, AFailureThatWasMendedIsNone) {
  TaskRecord first;
  first.state = "failed";
  first.failures = {{"a", "disk full"}};
  record("1", first);
  result("a");
  EXPECT_THAT(status({{"a", 1}}).items, ElementsAre(Item::kDone));
  EXPECT_TRUE(status({{"a", 1}}).failures.empty());
}

TEST_F(WorkStatusTest, RecordsOfOtherWorkDoNotCount) {
  TaskRecord other = running_here("a");
  other.work = "of another configuration";
  record("1", other);
  std::ofstream(tasks_folder(folder_) / "2.json") << "{";
  const WorkStatus found = status({{"a", 1}});
  EXPECT_THAT(found.items, ElementsAre(Item::kMissing));
  ASSERT_EQ(found.warnings.size(), 1);
  EXPECT_THAT(found.warnings[0], testing::HasSubstr("2.json"));
}

}  // namespace
}  // namespace indet
