#include "apps/batch/shard.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace indet {
namespace {

using testing::Each;
using testing::ElementsAre;

TEST(Shard, IsReadFromItsName) {
  const auto shard = shard_from("3/8");
  ASSERT_TRUE(shard);
  EXPECT_EQ(shard->number, 3);
  EXPECT_EQ(shard->count, 8);
  EXPECT_EQ(shard->name(), "3/8");
  for (const char* text :
       {"", "3", "3/", "/8", "0/8", "9/8", "-1/8", "3/8 ", "3/8/1", "a/b", "3/99999999999"})
    EXPECT_FALSE(shard_from(text)) << text;
}

TEST(Deal, GivesEachGroupToOneShare) {
  EXPECT_THAT(deal({1, 1, 1, 1}, 1), Each(1));
  EXPECT_THAT(deal({}, 3), ElementsAre());
  EXPECT_THAT(deal({5, 4, 3, 3, 3}, 2), ElementsAre(1, 2, 2, 1, 2));
}

TEST(Deal, LeavesNoShareEmptyWhereThereAreGroupsEnough) {
  const std::vector<int> shares = deal(std::vector<double>(60, 2.5), 7);
  EXPECT_EQ(std::set<int>(shares.begin(), shares.end()).size(), 7);
  for (int number = 1; number <= 7; ++number)
    EXPECT_NEAR(static_cast<double>(std::count(shares.begin(), shares.end(), number)), 60.0 / 7, 1);
}

TEST(Deal, KeepsTheDearestShareWithinGrahamsBound) {
  std::vector<double> costs;
  for (int i = 1; i <= 50; ++i) costs.push_back(1 + (i * 37) % 11);
  const std::vector<int> shares = deal(costs, 6);
  std::vector<double> loads(6, 0);
  for (std::size_t i = 0; i < costs.size(); ++i) loads[static_cast<std::size_t>(shares[i] - 1)] += costs[i];
  const double least_possible = std::accumulate(costs.begin(), costs.end(), 0.0) / 6;
  EXPECT_LE(*std::max_element(loads.begin(), loads.end()), 4.0 / 3 * std::max(least_possible, 11.0));
}

}  // namespace
}  // namespace indet
