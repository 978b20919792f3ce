#include <gtest/gtest.h>

#include <string>

#include "libindet/range/analyze.h"
#include "tests/support/compare.h"
#include "tests/support/scene_builder.h"

namespace indet {
namespace {

/// Four disks in a corner, two by two, on which two large smooth disks press from above and from the right,
/// each guided between two smooth walls; without gravity. The guides can jam, so the polytope is unbounded.
///
///        | (4) |
///       ────────
///      |  2  3   |        ───
///      |  0  1   | (5)
///       ────────            ───
struct Piston {
  double radius;  ///< of the large disks
  double from_right, from_above;
  double mu;
};

Packing packing_of(const Piston& piston) {
  Packing packing;
  packing.named_force_unit = 1;
  for (const Vector2& centre : {Vector2(1, 1), Vector2(3, 1), Vector2(1, 3), Vector2(3, 3)})
    zoo::add_disk(packing, centre);
  const double R = piston.radius;
  const DiskId above = zoo::add_disk(packing, {2, 4 + R}, R);
  const DiskId right = zoo::add_disk(packing, {4 + R, 2}, R);
  packing.disks[4].load = {0, -piston.from_above, 0};
  packing.disks[5].load = {-piston.from_right, 0, 0};
  const auto wall = [&](Vector2 point, Vector2 normal) {
    return Body::wall(zoo::add_wall(packing, point, normal));
  };
  const Body bottom = wall({0, 0}, {0, 1});
  const Body left = wall({0, 0}, {1, 0});
  const Body guides[] = {wall({2 - R, 0}, {1, 0}), wall({2 + R, 0}, {-1, 0}), wall({0, 2 - R}, {0, 1}),
                         wall({0, 2 + R}, {0, -1})};
  const auto disk = [](int i) { return DiskId(i); };
  zoo::touch(packing, disk(0), Body::disk(disk(1)), piston.mu);
  zoo::touch(packing, disk(2), Body::disk(disk(3)), piston.mu);
  zoo::touch(packing, disk(2), Body::disk(disk(0)), piston.mu);
  zoo::touch(packing, disk(3), Body::disk(disk(1)), piston.mu);
  for (const int i : {0, 1}) zoo::touch(packing, disk(i), bottom, piston.mu);
  for (const int i : {0, 2}) zoo::touch(packing, disk(i), left, piston.mu);
  for (const int i : {2, 3}) zoo::touch(packing, above, Body::disk(disk(i)), 0);
  for (const int i : {1, 3}) zoo::touch(packing, right, Body::disk(disk(i)), 0);
  for (const int i : {0, 1}) zoo::touch(packing, above, guides[i], 0);
  for (const int i : {2, 3}) zoo::touch(packing, right, guides[i], 0);
  return packing;
}

// In each of these GLPK calls the dual of some objective infeasible, which would make the objective
// unbounded; which one hangs on rounding.
TEST(Piston, WhatOneFormulationMissesAnotherFinds) {
  for (const Piston& piston :
       {Piston{1000, 10, 10, 0.3}, Piston{1500, 5, 5, 0.5}, Piston{2400, 10, 5, 0.3}, Piston{4000, 1, 1, 0.2},
        Piston{12000, 5, 5, 0.1}, Piston{20000, 10, 10, 0.3}, Piston{1500, 20, 5, 0.2}}) {
    SCOPED_TRACE("radius " + std::to_string(piston.radius) + ", friction " + std::to_string(piston.mu));
    const Packing packing = packing_of(piston);
    AnalyzeOptions options;
    options.formulation = Formulation::kEdge;
    const ForceRanges right = analyze(packing, options);
    ASSERT_EQ(right.status, PolytopeStatus::kUnbounded);
    EXPECT_EQ(right.certified, 64);
    EXPECT_EQ(right.unbounded, 4) << "the guides";
    for (const Formulation formulation : {Formulation::kDual, Formulation::kNullSpace}) {
      options.formulation = formulation;
      options.threads = 1;
      const ForceRanges ranges = analyze(packing, options);
      EXPECT_EQ(ranges.failed, 0) << to_string(formulation);
      EXPECT_EQ(ranges.certified, 64) << to_string(formulation);
      EXPECT_TRUE((ranges.outcome == right.outcome).all()) << to_string(formulation);
      EXPECT_TRUE(test::same_entries(right.value, ranges.value, 1e-8)) << to_string(formulation);
      options.threads = 2;
      EXPECT_TRUE(test::same_bytes(ranges, analyze(packing, options))) << to_string(formulation);
    }
  }
}

}  // namespace
}  // namespace indet
