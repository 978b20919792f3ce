#include "tests/support/compare.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include "libindet/range/analyze.h"
#include "libindet/range/result_fields.h"
#include "tests/support/zoo.h"

namespace indet::test {
namespace {

// Each comparator must be able to fail.

TEST(Compare, NearTellsInfinitiesApart) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(near(infinity, infinity, 1e-9));
  EXPECT_FALSE(near(infinity, -infinity, 1e-9));
  EXPECT_FALSE(near(infinity, 1, 1e-9));
  EXPECT_FALSE(near(1, ForceRanges::kNaN, 1e-9));
  EXPECT_TRUE(near(1000, 1000 + 1e-7, 1e-9));
  EXPECT_FALSE(near(1, 1 + 1e-7, 1e-9));
}

/// Ranges in which every field has something to say.
ForceRanges ranges_with_everything() {
  AnalyzeOptions options;
  options.contacts = {ContactChoice::Kind::kSample, 2, 1, {}};
  options.method = Method::kPivotingPaper;
  options.paper.neighbour = NeighbourRule::kRandom;
  return analyze(zoo::wedge(0.4, 0.3), options);
}

/// Changes one number, or makes a row where there is none.
template <class Value>
void change(Value&& value) {
  using Number = std::decay_t<Value>;
  if constexpr (requires { value.rows(); }) {
    if (value.size() == 0) {
      value.resize(1, value.cols());
      value.setZero();
      return;
    }
    change(value(value.rows() - 1, value.cols() - 1));
  } else if constexpr (std::is_same_v<Number, std::string>) {
    value += "x";
  } else if constexpr (requires { std::get<2>(value); }) {
    change(std::get<2>(value));
  } else if constexpr (std::is_same_v<Number, double>) {
    value = std::isfinite(value) ? value + 1e-6 : 0;
  } else {
    value = static_cast<Number>(value == Number{} ? 1 : static_cast<int>(value) - 1);
  }
}

/// Calls check(field, changed) for each field of the list, with `ranges` changed in it alone.
template <class Check>
void for_each_changed_field(const ForceRanges& ranges, Check check) {
  int fields = 0;
  visit_fields(ranges, [&](const Field&, const auto&) { ++fields; });
  ASSERT_GT(fields, 50);
  for (int chosen = 0; chosen < fields; ++chosen) {
    ForceRanges changed = ranges;
    int number = 0;
    Field field{};
    visit_fields(changed, [&]<class Value>(const Field& visited, Value&& value) {
      if (number++ != chosen) return;
      field = visited;
      change(value);
    });
    check(field, changed);
  }
}

TEST(Compare, SameBytesSeesAChangeOfEveryField) {
  const ForceRanges ranges = ranges_with_everything();
  EXPECT_TRUE(same_bytes(ranges, ranges));
  for_each_changed_field(ranges, [&](const Field& field, const ForceRanges& changed) {
    EXPECT_FALSE(same_bytes(ranges, changed)) << field.group << "/" << field.name;
  });
  ForceRanges changed = ranges;
  changed.value(1, kMaxT) = std::nextafter(changed.value(1, kMaxT), 10);
  EXPECT_FALSE(same_bytes(ranges, changed)) << "one bit";
  changed = ranges;
  changed.seconds["ranges"] += 1;
  EXPECT_TRUE(same_bytes(ranges, changed));
  changed.solver_states = SolverStates{ranges.states, ranges.vertex};
  EXPECT_FALSE(same_bytes(ranges, changed));
  ForceRanges other = changed;
  EXPECT_TRUE(same_bytes(changed, other));
  other.solver_states->vertex(0, 0) += 1;
  EXPECT_FALSE(same_bytes(changed, other));
}

/// Whatever is larger than padding between two fields of the list is a field that is not in it.
TEST(Compare, TheListHasEveryField) {
  const ForceRanges ranges;
  const auto* const start = reinterpret_cast<const char*>(&ranges);
  std::vector<bool> known(sizeof(ranges), false);
  const auto mark = [&](const auto& value) {
    const auto offset = reinterpret_cast<const char*>(&value) - start;
    if (offset < 0 || offset >= static_cast<std::ptrdiff_t>(sizeof(ranges))) return;  // a view of a column
    std::fill_n(known.begin() + offset, sizeof(value), true);
  };
  visit_fields(ranges, [&](const Field&, const auto& value) {
    if constexpr (requires { std::get<2>(value); }) {
      std::apply([&](const auto&... numbers) { (mark(numbers), ...); }, value);
    } else {
      mark(value);
    }
  });
  mark(ranges.value);  // visited by columns
  mark(ranges.seconds);
  mark(ranges.solver_states);  // of the search alone, in no file
  std::size_t unknown = 0;
  for (std::size_t k = 0; k < known.size(); ++k) {
    unknown = known[k] ? 0 : unknown + 1;
    ASSERT_LT(unknown, alignof(ForceRanges)) << "at byte " << k;
  }
}

TEST(Compare, SameRangesSeesAChangeOfEveryFieldThatFollowsFromThePacking) {
  const ForceRanges ranges = ranges_with_everything();
  EXPECT_TRUE(same_ranges(ranges, ranges, 1e-12));
  for_each_changed_field(ranges, [&](const Field& field, const ForceRanges& changed) {
    if (field.source == FieldSource::kEnclosure) return;  // seen where it does not overlap
    const bool is_seen = field.source == FieldSource::kProblem || field.source == FieldSource::kAnswer ||
                         field.source == FieldSource::kState;
    EXPECT_EQ(!same_ranges(ranges, changed, 1e-9), is_seen) << field.group << "/" << field.name;
  });
  EXPECT_FALSE(same_ranges(ranges, mirrored(ranges), 1e-9));
}

TEST(Compare, SameRangesSeesEnclosuresThatDoNotOverlap) {
  const ForceRanges ranges = analyze(zoo::wedge(0.4, 0.3));
  ForceRanges changed = ranges;
  changed.lower.array() -= 1e-6;
  changed.upper.array() += 1e-6;
  EXPECT_TRUE(same_ranges(ranges, changed, 1e-9)) << "wider ones of the same values";
  changed.lower(1, kMinT) = ranges.upper(1, kMinT) + 1e-6;
  EXPECT_FALSE(same_ranges(ranges, changed, 1e-9));
  changed = ranges;
  changed.upper(0, kMaxR) = ranges.lower(0, kMaxR) - 1e-6;
  EXPECT_FALSE(same_ranges(ranges, changed, 1e-9));
  changed = ranges;
  changed.lower(0, kMaxR) = ForceRanges::kNaN;
  EXPECT_FALSE(same_ranges(ranges, changed, 1e-9));
}

TEST(Compare, SameRangesAndWeightsSeesTheNormalForceOfAStateAlone) {
  const ForceRanges ranges = analyze(zoo::wedge(0.4, 0.3));
  ForceRanges changed = ranges;
  changed.states.array() += 1e-6;
  EXPECT_FALSE(same_ranges_and_weights(ranges, changed, 1e-9));
  changed = ranges;
  changed.states.col(1).array() += 1e-6;
  EXPECT_FALSE(same_ranges(ranges, changed, 1e-9));
  EXPECT_TRUE(same_ranges_and_weights(ranges, changed, 1e-9)) << "normal forces are the same";
}

TEST(Compare, FallingMotionIsMultipliedBack) {
  const Packing packing = zoo::disk_on_incline(0.3, 0.5);
  // Rolling down: centre along (cos, −sin), turning so that the point of contact rests.
  Eigen::MatrixXd motion(1, 3);
  motion << std::cos(0.3), -std::sin(0.3), -1;
  EXPECT_TRUE(is_falling_motion(packing, motion, 1e-12));
  EXPECT_FALSE(is_falling_motion(packing, -motion, 1e-12)) << "uphill";
  motion(0, 2) = 0;
  motion /= motion.cwiseAbs().maxCoeff();
  EXPECT_FALSE(is_falling_motion(packing, motion, 1e-12)) << "slides against friction";
  EXPECT_FALSE(is_falling_motion(packing, 2 * motion, 1e-12)) << "not normalised";
}

TEST(Compare, RayIsMultipliedBack) {
  const Packing packing = zoo::pinched_disk(0.3);
  EXPECT_TRUE(is_recession_ray(packing, Eigen::Vector4d(1, 0, 1, 0), 1e-12));
  EXPECT_FALSE(is_recession_ray(packing, Eigen::Vector4d(1, 0, 2, 0), 1e-12)) << "not balanced";
  EXPECT_FALSE(is_recession_ray(packing, Eigen::Vector4d(-1, 0, -1, 0), 1e-12)) << "pulls";
  EXPECT_FALSE(is_recession_ray(packing, Eigen::Vector4d(1, 0.5, 1, -0.5), 1e-12)) << "beyond friction";
  EXPECT_FALSE(is_recession_ray(packing, Eigen::Vector4d::Zero(), 1e-12));
}

TEST(Compare, EveryInfiniteEndNeedsItsOwnRay) {
  const Packing packing = zoo::wedge(1.4, 0.3);
  const ForceRanges ranges = analyze(packing);
  EXPECT_TRUE(has_rays_where_infinite(packing, ranges, 1e-12));
  ForceRanges changed = ranges;
  changed.ray(0, kMaxR) = -1;
  EXPECT_FALSE(has_rays_where_infinite(packing, changed, 1e-12));
  changed = ranges;
  changed.value(0, kMaxR) *= -1;
  EXPECT_FALSE(has_rays_where_infinite(packing, changed, 1e-12));
  changed = ranges;
  changed.rays(0, 0) += 0.1;
  EXPECT_FALSE(has_rays_where_infinite(packing, changed, 1e-12));
}

}  // namespace
}  // namespace indet::test
