#include "libsim/scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>

#include "libindet/base/error.h"
#include "libindet/base/random.h"
#include "libsim/scene_toml.h"
#include "tests/sim/worlds.h"
#include "tests/support/temporary_folder.h"

namespace indet::sim {
namespace {

using ::testing::HasSubstr;

TEST(Scene, DefaultIsThePapersBox) {
  const Scene full = Scene{}.resolved();
  EXPECT_EQ(full.columns, 5);
  EXPECT_DOUBLE_EQ(full.width, 11);
  EXPECT_DOUBLE_EQ(full.height, 38);
  const World world = build(Scene{});
  EXPECT_EQ(world.size(), 95);
  EXPECT_EQ(world.walls.size(), 3u);
}

TEST(Scene, DisksStayApartAndInside) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Scene scene;
    scene.disks = 137;
    scene.seed = seed;
    const World world = build(scene);
    const double width = scene.resolved().width;
    for (int i = 0; i < world.size(); ++i) {
      EXPECT_GE(world.radius[i], 0.7);
      EXPECT_LT(world.radius[i], 1);
      EXPECT_GE(world.x[i], world.radius[i]);
      EXPECT_LE(world.x[i], width - world.radius[i]);
      EXPECT_GE(world.y[i], world.radius[i]);
      for (int j = 0; j < i; ++j) {
        EXPECT_GE(std::hypot(world.x[i] - world.x[j], world.y[i] - world.y[j]) + 1e-12,
                  world.radius[i] + world.radius[j]);
      }
    }
  }
}

/// The sizes that the scene chooses for itself fit its disks, however they round.
TEST(Scene, TheSizesThatItChoosesFit) {
  Random random(5);
  for (int i = 0; i < 20000; ++i) {
    Scene scene;
    scene.radius_max = std::exp(random.uniform(-5, 5));
    scene.radius_min = scene.radius_max * random.uniform(0.3, 1);
    scene.columns = 1 + i % 7;
    scene.disks = 1 + i % 97;
    ASSERT_EQ(scene.defect(), std::nullopt) << scene.radius_max;
    scene.width = 2 * scene.radius_max * scene.columns;
    ASSERT_EQ(scene.defect(), std::nullopt) << scene.radius_max;
    scene.width *= 1 - 1e-9;
    ASSERT_NE(scene.defect(), std::nullopt) << scene.radius_max;
  }
}

TEST(Scene, SeedDecidesEverything) {
  EXPECT_EQ(build(Scene{.seed = 3}).x, build(Scene{.seed = 3}).x);
  EXPECT_NE(build(Scene{.seed = 3}).radius, build(Scene{.seed = 4}).radius);
}

TEST(Scene, FunnelLeadsToTheMiddle) {
  Scene scene;
  scene.container = Container::kFunnel;
  scene.funnel_angle = 40;
  const World world = build(scene);
  for (int i = 0; i < world.size(); ++i) {
    for (const Wall& wall : world.walls) {
      EXPECT_GE((Vector2(world.x[i], world.y[i]) - wall.point).dot(wall.normal) + 1e-12, world.radius[i]);
    }
  }
}

/// A half-plane that cuts the lower left corner of the box off, up to a distance d from it along the
/// diagonal: the disk of radius 1 in the corner touches both walls at (1, 1), and a ramp with n̂ = (1, 1)/√2
/// through d n̂ leaves it its place as long as √2 − d ≥ 1.
TEST(Scene, ADiskMayTouchAWallButNotStartInIt) {
  Scene scene{.disks = 1, .radius_min = 1, .radius_max = 1, .width = 2, .height = 2};
  const Vector2 normal = Vector2(1, 1) / std::sqrt(2.0);
  const auto with_ramp = [&](double distance) {
    scene.walls = {Wall{.point = distance * normal, .normal = normal, .name = "ramp"}};
    return scene;
  };
  EXPECT_EQ(build(with_ramp(std::sqrt(2.0) - 1)).size(), 1);
  EXPECT_THAT(
      [&] { build(with_ramp(std::sqrt(2.0) - 1 + 1e-9)); },
      ::testing::ThrowsMessage<InputError>(HasSubstr("starts 1e-09 inside wall ramp: the grid of 1 × 1 "
                                                     "cells fills 0 ≤ x ≤ 2, 0 ≤ y ≤ 2")));
}

TEST(Scene, NoScenesThatItChoosesStartInsideAWall) {
  Random random(8);
  for (int i = 0; i < 3000; ++i) {
    Scene scene;
    scene.seed = static_cast<std::uint64_t>(i);
    scene.radius_max = std::exp(random.uniform(-5, 5));
    scene.radius_min = scene.radius_max * random.uniform(0.3, 1);
    scene.columns = 1 + i % 7;
    scene.disks = 1 + i % 97;
    if (i % 2 == 0) scene.width = 2 * scene.radius_max * scene.columns;
    scene.container = i % 3 == 0 ? Container::kFunnel : Container::kBox;
    scene.funnel_angle = random.uniform(1, 80);
    ASSERT_EQ(build(scene).size(), scene.disks) << i;
  }
}

struct BadScene {
  const char* name;
  void (*spoil)(Scene&);
  const char* reason;
};

void PrintTo(const BadScene& scene, std::ostream* stream) { *stream << scene.name; }

class SceneBad : public ::testing::TestWithParam<BadScene> {};

TEST_P(SceneBad, IsRefusedWithTheReason) {
  Scene scene;
  GetParam().spoil(scene);
  ASSERT_TRUE(scene.defect().has_value());
  EXPECT_THAT(*scene.defect(), HasSubstr(GetParam().reason));
  EXPECT_THROW(build(scene), InputError);
}

INSTANTIATE_TEST_SUITE_P(
    All, SceneBad,
    ::testing::Values(BadScene{"NoDisks", [](Scene& s) { s.disks = 0; }, "disks"},
                      BadScene{"Radii", [](Scene& s) { s.radius_min = 2; }, "radii"},
                      BadScene{"Density", [](Scene& s) { s.density = 0; }, "density"},
                      BadScene{"Friction", [](Scene& s) { s.friction.wall = -1; }, "friction"},
                      BadScene{"NoUnit",
                               [](Scene& s) {
                                 s.gravity = {0, 0};
                               },
                               "force_unit"},
                      BadScene{"Jitter", [](Scene& s) { s.jitter = 2; }, "jitter"},
                      BadScene{"Narrow",
                               [](Scene& s) {
                                 s.width = 9;
                                 s.columns = 5;
                               },
                               "too small"},
                      BadScene{"Funnel", [](Scene& s) { s.funnel_angle = 95; }, "funnel_angle"},
                      BadScene{"Wall",
                               [](Scene& s) {
                                 s.walls.push_back(Wall{.normal = {0, 2}, .name = ""});
                               },
                               "length 1"}),
    [](const auto& instance) { return instance.param.name; });

TEST(SceneToml, ReadsBackWhatItWrites) {
  Scene scene;
  scene.disks = 12;
  scene.radius_min = 1.0 / 3;
  scene.friction = {0.1, 0.7};
  scene.container = Container::kFloor;
  scene.seed = 77;
  scene.walls.push_back(Wall{.point = {0.5, -3}, .normal = {0.6, 0.8}, .name = "ramp"});
  const std::string text = to_toml(scene);
  const test::TemporaryFolder folder;
  folder.write("scene.toml", text);
  EXPECT_EQ(to_toml(read_scene(folder / "scene.toml")), text);
}

TEST(SceneToml, NamesTheLineThatIsWrong) {
  const test::TemporaryFolder folder;
  folder.write("scene.toml", "disks = 3\ngravity = 1\n");
  try {
    read_scene(folder / "scene.toml");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("scene.toml:2: gravity must be two numbers"));
  }
}

TEST(Container, NamesAreReadBack) {
  EXPECT_EQ(container_from(to_string(Container::kFunnel)), Container::kFunnel);
  EXPECT_THROW(container_from("bucket"), InputError);
}

/// Two disks on a floor that touch; friction 0.1 and 0.2 with the floor, 0.5 with each other.
Packing unlike_contacts() {
  World world = empty_world();
  add_wall(world, {0, 0}, {0, 1});
  add_disk(world, {0, 1});
  add_disk(world, {2, 1});
  return packing_of(
      world, {{.a = 0, .b = -1, .mu = 0.1}, {.a = 0, .b = 1, .mu = 0.5}, {.a = 1, .b = -1, .mu = 0.2}});
}

TEST(FrictionOf, RefusesUnlikeContactsOfAKindThatNobodyChose) {
  EXPECT_THROW(friction_of(unlike_contacts()), InputError);
  EXPECT_THROW(friction_of(unlike_contacts(), {.disk = 0.4, .wall = {}}), InputError);
}

TEST(FrictionOf, ChoiceOverridesContacts) {
  const Friction friction = friction_of(unlike_contacts(), {.disk = {}, .wall = 0.3});
  EXPECT_EQ(friction.wall, 0.3);
  EXPECT_EQ(friction.disk, 0.5);
  EXPECT_EQ(friction_of(unlike_contacts(), {.disk = 0.7, .wall = 0.3}).disk, 0.7);
}

}  // namespace
}  // namespace indet::sim
