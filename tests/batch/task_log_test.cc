#include "apps/batch/task_log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "libindet/base/error.h"

namespace indet {
namespace {

namespace fs = std::filesystem;

class TaskLogTest : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  TaskRecord only_record() const {
    std::vector<fs::path> paths;
    for (const auto& entry : fs::directory_iterator(tasks_folder(folder_))) paths.push_back(entry.path());
    EXPECT_EQ(paths.size(), 1);
    return read_task_record(paths.front());
  }

  fs::path folder_ = fs::temp_directory_path() / ("task-log-" + std::to_string(getpid()));
};

TEST_F(TaskLogTest, TellsWhatAProcessIsAtAndWhatItDid) {
  {
    TaskLog log(folder_, {.work = "digest", .shard = "shard 3/8", .job = "117_3"}, {});
    log.begin("cd1-0000");
    log.begin("cd1-0001");
    log.finish("cd1-0001", {{"simulate", 1.5}, {"analyze", 0.25}});
    log.refresh();  // at once, as it got further
    const TaskRecord record = only_record();
    EXPECT_EQ(record.work, "digest");
    EXPECT_EQ(record.shard, "shard 3/8");
    EXPECT_EQ(record.job, "117_3");
    EXPECT_EQ(record.process, getpid());
    EXPECT_EQ(record.state, "running");
    EXPECT_TRUE(record.got_further);
    ASSERT_EQ(record.in_hand.size(), 1);
    EXPECT_EQ(record.in_hand[0].name, "cd1-0000");
    EXPECT_GE(record.in_hand[0].since, record.started);
    ASSERT_EQ(record.done.size(), 1);
    EXPECT_EQ(record.done[0].seconds.at("analyze"), 0.25);
    log.fail("cd1-0000", "is not UTF-8: \xff");
  }
  const TaskRecord record = only_record();
  EXPECT_EQ(record.state, "stopped");
  EXPECT_TRUE(record.in_hand.empty());
  ASSERT_EQ(record.failures.size(), 1);
  EXPECT_EQ(record.failures[0].item, "cd1-0000");
}

TEST_F(TaskLogTest, HasNotGotFurtherByFailing) {
  TaskLog log(folder_, {}, {});
  log.begin("a");
  log.fail("a", "no");
  log.leave("b", true);
  log.end("failed");
  const TaskRecord record = only_record();
  EXPECT_FALSE(record.got_further);
  EXPECT_EQ(record.there_already, 1);
  EXPECT_EQ(record.state, "failed");
}

TEST_F(TaskLogTest, WarnsOnceWhereItCannotBeWritten) {
  std::ofstream(tasks_folder(folder_)) << "a file, not a folder";
  int warnings = 0;
  TaskLog log(folder_, {}, [&](const std::string& text) {
    ++warnings;
    EXPECT_THAT(text, testing::HasSubstr("tasks"));
  });
  log.end("done");
  EXPECT_EQ(warnings, 1);
}

TEST_F(TaskLogTest, OtherFilesAreNoRecords) {
  const fs::path path = folder_ / "other.json";
  std::ofstream(path) << "{\"done\": 3}";
  EXPECT_THROW(read_task_record(path), InputError);
  std::ofstream(path) << "not json";
  EXPECT_THROW(read_task_record(path), InputError);
}

}  // namespace
}  // namespace indet
