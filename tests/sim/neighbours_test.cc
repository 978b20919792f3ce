#include "libsim/neighbours.h"

#include <gtest/gtest.h>

#include <vector>

#include "libindet/base/random.h"
#include "tests/sim/worlds.h"

namespace indet::sim {
namespace {

World scattered(int count, double spread, std::uint64_t seed) {
  World world = empty_world();
  add_wall(world, {0, 0}, {0, 1});
  add_wall(world, {-spread, 0}, {1, 0});
  Random random(seed);
  for (int i = 0; i < count; ++i) {
    add_disk(world, {random.uniform(-spread, spread), random.uniform(-spread, spread)},
             random.uniform(0.3, 1));
  }
  return world;
}

TEST(NeighbourList, HoldsExactlyThePairsInReach) {
  for (const double spread : {3.0, 30.0, 1e7}) {
    const World world = scattered(200, spread, 11);
    NeighbourList list(0.2);
    list.rebuild(world, 0.05);
    for (int i = 0; i < world.size(); ++i) {
      std::vector<int> disks;
      for (int j = i + 1; j < world.size(); ++j) {
        const double distance = std::hypot(world.x[i] - world.x[j], world.y[i] - world.y[j]);
        if (distance <= world.radius[i] + world.radius[j] + 0.25) disks.push_back(j);
      }
      const auto found = list.disks_near(i);
      EXPECT_EQ(std::vector<int>(found.begin(), found.end()), disks);
      std::vector<int> walls;
      if (world.y[i] - world.radius[i] <= 0.25) walls.push_back(0);
      if (world.x[i] + spread - world.radius[i] <= 0.25) walls.push_back(1);
      const auto found_walls = list.walls_near(i);
      EXPECT_EQ(std::vector<int>(found_walls.begin(), found_walls.end()), walls);
    }
  }
}

TEST(NeighbourList, IsMadeAnewOnlyOnceADiskHasMovedByHalfTheSkin) {
  World world = scattered(50, 10, 1);
  NeighbourList list(0.2);
  EXPECT_TRUE(list.update(world, 0));
  world.x[7] += 0.09;
  EXPECT_FALSE(list.update(world, 0));
  world.x[7] += 0.02;
  EXPECT_TRUE(list.update(world, 0));
  EXPECT_TRUE(list.update(world, 0.1));
}

}  // namespace
}  // namespace indet::sim
