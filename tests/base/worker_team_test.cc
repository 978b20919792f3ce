#include "libindet/base/worker_team.h"

#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace indet {
namespace {

class WorkerTeams : public testing::TestWithParam<int> {};

TEST_P(WorkerTeams, EveryTaskIsDoneOnceInEveryRun) {
  WorkerTeam team(GetParam());
  for (const int count : {0, 1, 2, 100}) {
    for (int repeat = 0; repeat < 50; ++repeat) {
      std::vector<std::atomic<int>> done(static_cast<std::size_t>(count));
      team.run(count, [&](int worker, std::int64_t index) {
        EXPECT_GE(worker, 0);
        EXPECT_LT(worker, team.workers());
        ++done[static_cast<std::size_t>(index)];
      });
      for (const auto& times : done) ASSERT_EQ(times, 1);
    }
  }
}

TEST_P(WorkerTeams, AWorkerKeepsItsThread) {
  WorkerTeam team(GetParam());
  std::vector<std::set<std::thread::id>> threads(static_cast<std::size_t>(team.workers()));
  for (int repeat = 0; repeat < 30; ++repeat) {
    team.run(20, [&](int worker, std::int64_t) {
      threads[static_cast<std::size_t>(worker)].insert(std::this_thread::get_id());
    });
  }
  for (const auto& ids : threads) EXPECT_LE(ids.size(), 1U);
}

TEST_P(WorkerTeams, APinnedTaskStaysOnItsThread) {
  WorkerTeam team(GetParam());
  std::vector<std::thread::id> threads(20);
  for (int repeat = 0; repeat < 30; ++repeat) {
    std::vector<int> done(threads.size());
    team.run_pinned(static_cast<std::int64_t>(threads.size()), [&](int worker, std::int64_t index) {
      const auto at = static_cast<std::size_t>(index);
      EXPECT_EQ(worker, index % team.workers());
      if (repeat == 0) threads[at] = std::this_thread::get_id();
      EXPECT_EQ(threads[at], std::this_thread::get_id());
      ++done[at];
    });
    for (const int times : done) ASSERT_EQ(times, 1);
  }
}

TEST_P(WorkerTeams, TheFirstFailureIsThrownAndTheTeamGoesOn) {
  WorkerTeam team(GetParam());
  for (int repeat = 0; repeat < 20; ++repeat) {
    try {
      team.run(50, [](int, std::int64_t index) {
        if (index % 7 == 3) throw std::runtime_error(std::to_string(index));
      });
      FAIL() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "3");
    }
    std::atomic<int> done = 0;
    team.run(10, [&](int, std::int64_t) { ++done; });
    EXPECT_EQ(done, 10);
  }
}

TEST_P(WorkerTeams, ExitRunsOnTheThreadOfEachFurtherWorker) {
  std::mutex mutex;
  std::set<int> left;
  std::set<std::thread::id> threads;
  {
    WorkerTeam team(GetParam(), [&](int worker) {
      const std::scoped_lock lock(mutex);
      left.insert(worker);
      threads.insert(std::this_thread::get_id());
    });
  }
  EXPECT_EQ(static_cast<int>(left.size()), GetParam() - 1);
  EXPECT_EQ(left.count(0), 0U);
  EXPECT_EQ(threads.count(std::this_thread::get_id()), 0U);
}

INSTANTIATE_TEST_SUITE_P(Sizes, WorkerTeams, testing::Values(1, 2, 3, 7));

TEST(WorkerTeam, OneWorkerRunsOnTheCallingThread) {
  WorkerTeam team(1);
  std::thread::id where;
  team.run(1, [&](int, std::int64_t) { where = std::this_thread::get_id(); });
  EXPECT_EQ(where, std::this_thread::get_id());
  EXPECT_EQ(WorkerTeam(0).workers(), 1);
}

}  // namespace
}  // namespace indet
