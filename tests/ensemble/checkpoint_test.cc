#include "apps/ensemble/members/checkpoint.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "apps/ensemble/members/folder.h"
#include "apps/ensemble/members/run.h"

namespace indet {
namespace {

namespace fs = std::filesystem;

class MemberCheckpointTest : public testing::Test {
 protected:
  void SetUp() override {
    config_.scene.disks = 40;
    config_.seeds = 1;
    config_.protocols = {sim::Protocol::kMd1};
    config_.sampling.samples = 0;
    config_.uniform_seeds = config_.paper_walk_seeds = config_.limit_seeds = 0;
    plan_ = make_plan(config_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string digest_of(const fs::path& folder) const {
    return open_indet_file(member_path(folder, plan_.members.front().name))
        .sha256({"/contacts", "/particles", "/ranges", "/simulation"});
  }

  fs::path folder_ = fs::temp_directory_path() / ("member-checkpoint-" + std::to_string(getpid()));
  EnsembleConfig config_;
  Plan plan_;
};

TEST_F(MemberCheckpointTest, AnInterruptedSimulationGoesOnToTheSameResult) {
  RunOptions options;
  options.checkpoints.worth_keeping = 0;
  int written = 0, held = 0;
  options.checkpoints.on_written = [&] { ++written; };
  options.checkpoints.hold_on = [&] { return std::make_shared<int>(++held); };
  const fs::path whole = folder_ / "whole", stopped = folder_ / "stopped";
  EXPECT_EQ(compute_members(config_, plan_, plan_.members, whole, options).done, 1);

  int reports = 0;
  options.progress = [&](const Progress&) { return ++reports < 2; };  // some 0.1 s
  EXPECT_TRUE(compute_members(config_, plan_, plan_.members, stopped, options).is_interrupted);
  EXPECT_EQ(written, 1);
  EXPECT_GT(held, 0);
  const fs::path checkpoint = checkpoint_path(stopped, plan_.members.front().name);
  EXPECT_TRUE(fs::exists(checkpoint));
  EXPECT_FALSE(fs::exists(member_path(stopped, plan_.members.front().name)));

  options.progress = {};
  EXPECT_EQ(compute_members(config_, plan_, plan_.members, stopped, options).done, 1);
  EXPECT_FALSE(fs::exists(checkpoint));
  EXPECT_EQ(digest_of(stopped), digest_of(whole));
}

TEST_F(MemberCheckpointTest, IsNotMadeOfWhatIsSoonDoneAgain) {
  RunOptions options;
  int reports = 0;
  options.progress = [&](const Progress&) { return ++reports < 2; };
  EXPECT_TRUE(compute_members(config_, plan_, plan_.members, folder_, options).is_interrupted);
  EXPECT_FALSE(fs::exists(checkpoint_path(folder_, plan_.members.front().name)));
}

}  // namespace
}  // namespace indet
