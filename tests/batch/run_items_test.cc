#include "apps/batch/run_items.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <mutex>
#include <set>
#include <thread>

#include "libindet/base/error.h"

namespace indet {
namespace {

using testing::ElementsAre;

/// Work that notes what was computed, in the order in which it began.
struct Recorded {
  Batch batch;
  std::mutex mutex;
  std::vector<std::string> begun;
  std::set<std::size_t> finished;
  std::function<void(std::size_t)> act;

  explicit Recorded(std::vector<WorkItem> items) {
    batch.items = std::move(items);
    batch.is_done = [](std::size_t) { return false; };
    batch.compute = [this](std::size_t i, const ProgressCallback& progress) {
      {
        const std::scoped_lock lock(mutex);
        begun.push_back(batch.items[i].name);
      }
      if (act) act(i);
      if (!progress({})) throw Interrupted();
      const std::scoped_lock lock(mutex);
      finished.insert(i);
      return std::map<std::string, double>{{"simulate", 1.5}};
    };
  }
};

std::vector<WorkItem> numbered_items(int count, double cost) {
  std::vector<WorkItem> items;
  for (int i = 0; i < count; ++i) items.push_back({std::to_string(i), cost});
  return items;
}

TEST(RunItems, ComputesEachOnce) {
  for (const int threads : {1, 3}) {
    Recorded work(numbered_items(20, 1));
    work.batch.there_already = 2;
    const BatchSummary summary = run_items(work.batch, {.threads = threads});
    EXPECT_EQ(summary.done, 20);
    EXPECT_EQ(summary.there_already, 2);
    EXPECT_EQ(work.begun.size(), 20);
    EXPECT_EQ(work.finished.size(), 20);
  }
}

TEST(RunItems, WaitsForWhatAnItemStartsFrom) {
  // The third takes longest, and the first two start from it.
  std::vector<WorkItem> items = {{"b", 1, 2}, {"c", 1, 2}, {"a", 1}, {"d", 1, 1}};
  Recorded work(items);
  work.act = [&](std::size_t i) {
    if (i == 2) std::this_thread::sleep_for(std::chrono::milliseconds(50));
    const std::scoped_lock lock(work.mutex);
    if (!items[i].after) return;
    EXPECT_TRUE(work.finished.contains(*items[i].after)) << items[i].name;
  };
  EXPECT_EQ(run_items(work.batch, {.threads = 4}).done, 4);
  EXPECT_EQ(work.begun.front(), "a");
}

TEST(RunItems, GoesOnAfterAFailure) {
  Recorded work({{"a", 1}, {"b", 1, 0}, {"c", 1}});
  work.act = [](std::size_t i) {
    if (i != 1) throw LibraryError("does not settle");
  };
  const BatchSummary summary = run_items(work.batch, {});
  EXPECT_EQ(summary.done, 1);
  ASSERT_EQ(summary.failures.size(), 2);
  EXPECT_EQ(summary.failures[0].item, "a");
  EXPECT_EQ(summary.failures[0].reason, "does not settle");
  EXPECT_EQ(summary.failures[1].item, "c");
}

TEST(RunItems, GivesUpWhereNothingCanBeWritten) {
  Recorded work(numbered_items(10, 1));
  work.act = [](std::size_t) { throw WritingFailed("x: writing failed (No space left on device)"); };
  EXPECT_THROW(run_items(work.batch, {}), WritingFailed);
  EXPECT_EQ(work.begun.size(), 1);
}

TEST(RunItems, PassesOverWhatOthersHaveDone) {
  Recorded work(numbered_items(4, 1));
  work.batch.is_done = [](std::size_t i) { return i % 2 == 0; };
  const BatchSummary summary = run_items(work.batch, {});
  EXPECT_EQ(summary.done, 2);
  EXPECT_EQ(summary.there_already, 2);
  EXPECT_THAT(work.begun, ElementsAre("1", "3"));
}

TEST(RunItems, StopsWhenAsked) {
  Recorded work(numbered_items(1000, 1));
  work.act = [](std::size_t) { std::this_thread::sleep_for(std::chrono::milliseconds(5)); };
  BatchOptions options;
  options.threads = 2;
  options.progress = [](const Progress&) { return false; };
  const BatchSummary summary = run_items(work.batch, options);
  EXPECT_TRUE(summary.is_interrupted);
  EXPECT_LT(work.begun.size(), 1000);
}

TEST(RunItems, StartsNothingThatWillNotBeFinishedInTime) {
  // By the first one a second of cost takes 20 ms at least, so that of the large ones none fits into a
  // minute.
  Recorded work({{"a", 1}, {"b", 1e6}, {"c", 1e6}, {"d", 1}});
  work.act = [](std::size_t) { std::this_thread::sleep_for(std::chrono::milliseconds(20)); };
  const BatchSummary summary = run_items(work.batch, {.time_budget = 60});
  EXPECT_FALSE(summary.is_interrupted);
  EXPECT_EQ(summary.done, 2);
  EXPECT_EQ(summary.out_of_time, 2);
  EXPECT_THAT(work.begun, ElementsAre("a", "d"));
}

TEST(RunItems, StartsOneItemWhateverTheTime) {
  Recorded work(numbered_items(5, 1000));
  const BatchSummary summary = run_items(work.batch, {.time_budget = 0});
  EXPECT_EQ(summary.done, 1);
  EXPECT_EQ(summary.out_of_time, 4);
}

}  // namespace
}  // namespace indet
