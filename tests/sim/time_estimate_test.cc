#include "libsim/time_estimate.h"

#include <gtest/gtest.h>

#include <utility>

namespace indet::sim {
namespace {

TEST(TimeEstimate, IsWithinAFactorOfTwoOfWhatWasMeasured) {
  for (const auto& [disks, seconds] : {std::pair(200, 2), {400, 6}, {800, 23}, {1600, 63}, {3200, 177}}) {
    EXPECT_GT(seconds_estimate(Simulator::kContactDynamics, disks), seconds / 2.0) << disks;
    EXPECT_LT(seconds_estimate(Simulator::kContactDynamics, disks), seconds * 2.0) << disks;
  }
  for (const auto& [disks, seconds] : {std::pair(400, 15), {800, 29}, {1600, 115}, {10000, 1020}}) {
    EXPECT_GT(seconds_estimate(Simulator::kMolecularDynamics, disks), seconds / 2.0) << disks;
    EXPECT_LT(seconds_estimate(Simulator::kMolecularDynamics, disks), seconds * 2.0) << disks;
  }
}

TEST(TimeEstimate, IsToldWhereASimulationTakesLong) {
  EXPECT_EQ(time_notice(Simulator::kContactDynamics, 400), "");
  EXPECT_EQ(time_notice(Simulator::kMolecularDynamics, 400), "");
  const std::string text = time_notice(Simulator::kContactDynamics, 3200);
  EXPECT_NE(text.find("3200 disks by contact dynamics take about 3 minutes"), std::string::npos) << text;
  EXPECT_EQ(text.find("measured"), std::string::npos) << text;
  const std::string more = time_notice(Simulator::kContactDynamics, 6400);
  EXPECT_NE(more.find("measured with up to 3200 disks"), std::string::npos) << more;
}

TEST(TimeEstimate, ProposesMolecularDynamicsOnlyWhereItIsFaster) {
  for (const std::int64_t disks : {1600, 3200, 6400})
    EXPECT_EQ(time_notice(Simulator::kContactDynamics, disks).find("md1"), std::string::npos) << disks;
  EXPECT_NE(time_notice(Simulator::kContactDynamics, 20000).find("--protocol md1 takes about"),
            std::string::npos);
  EXPECT_EQ(time_notice(Simulator::kMolecularDynamics, 20000).find("md1"), std::string::npos);
}

}  // namespace
}  // namespace indet::sim
