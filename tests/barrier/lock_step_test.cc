#include "libindet/barrier/lock_step.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

#include "libindet/base/constants.h"
#include "libindet/base/random.h"
#include "libindet/range/analyze.h"
#include "tests/barrier/runs.h"
#include "tests/barrier/sets.h"

namespace indet::barrier {
namespace {

using test::minimise;
using test::packings;
using test::StrengthSet;
using test::vector;

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}
bool same_bits(const test::Run& a, const test::Run& b) {
  return a.finished && b.finished && same_bits(a.x, b.x) && same_bits(a.y, b.y) &&
         a.iterations == b.iterations && a.converged == b.converged;
}

double value_of(const Objective& objective, const std::vector<double>& x) {
  double value = 0;
  for (const auto& [column, weight] : objective) value += weight * x[static_cast<std::size_t>(column)];
  return value;
}

std::vector<std::size_t> in_order(std::size_t count) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), 0U);
  return order;
}

/// b·y ≤ least value ≤ c·x, not farther apart than was asked for, around the value of the linear program.
TEST(LockStep, FindsWhatLinearProgramsFind) {
  for (const auto& [name, packing] : packings()) {
    SCOPED_TRACE(name);
    StrengthSet set(packing);
    const AnalyticCentre centre = find_analytic_centre(set.structure, set.cholesky);
    ASSERT_TRUE(centre.found);
    const ForceRanges ranges = analyze(packing, options_for(Accuracy::kFast));
    ASSERT_NE(ranges.status, PolytopeStatus::kEmpty);
    const double unit = set.problem.units.internal_in_scene();
    const std::vector<Objective> objectives = set.objectives();
    for (const double gap : {1e-2, 1e-4, 1e-6, 1e-8}) {
      LockStepOptions options;
      options.gap = gap;
      const std::vector<test::Run> runs =
          minimise(set, centre, objectives, in_order(objectives.size()), options);
      for (std::size_t k = 0; k < runs.size(); ++k) {
        SCOPED_TRACE(testing::Message() << "gap " << gap << ", contact " << k / 4 << ", column " << k % 4);
        const test::Run& run = runs[k];
        ASSERT_TRUE(run.finished);
        EXPECT_TRUE(run.converged);
        const double sign = k % 2 == 0 ? 1 : -1;  // minima, maxima
        const double right =
            sign * ranges.value(static_cast<Eigen::Index>(k / 4), static_cast<Eigen::Index>(k % 4)) / unit;
        const double primal = value_of(objectives[k], run.x);
        const double dual = vector(set.structure.load()).dot(vector(run.y));
        const double size = std::max(1.0, std::abs(right));
        EXPECT_LE(primal - right, 1.01 * gap * size + 1e-9 * size);
        EXPECT_LE(right - dual, 1.01 * gap * size + 1e-9 * size);
        EXPECT_GE(primal - right, -1e-7 * size);
        EXPECT_GE(right - dual, -1e-7 * size);
        EXPECT_GT(*std::min_element(run.x.begin(), run.x.end()), 0);
      }
    }
  }
}

TEST(LockStep, GivesTheSameBitsForRegistersOfAnyWidth) {
  for (const auto& [name, packing] : packings()) {
    SCOPED_TRACE(name);
    StrengthSet set(packing);
    const AnalyticCentre centre = find_analytic_centre(set.structure, set.cholesky);
    const std::vector<Objective> objectives = set.objectives();
    LockStepOptions options;
    const std::vector<test::Run> widest =
        minimise(set, centre, objectives, in_order(objectives.size()), options);
    for (const int bits : {128, 256, 512, 1024, 0}) {
      options.vector_bits = bits;
      const std::vector<test::Run> runs =
          minimise(set, centre, objectives, in_order(objectives.size()), options);
      for (std::size_t k = 0; k < runs.size(); ++k)
        EXPECT_TRUE(same_bits(runs[k], widest[k])) << bits << ", " << k;
    }
  }
}

TEST(LockStep, GivesTheSameBitsInAnyOrderAndCompany) {
  Random random(31);
  for (const auto& [name, packing] : packings()) {
    SCOPED_TRACE(name);
    StrengthSet set(packing);
    const AnalyticCentre centre = find_analytic_centre(set.structure, set.cholesky);
    const std::vector<Objective> objectives = set.objectives();
    const std::vector<test::Run> right = minimise(set, centre, objectives, in_order(objectives.size()), {});
    for (const int bits : {128, 256, 512}) {
      LockStepOptions options;
      options.vector_bits = bits;
      for (int repeat = 0; repeat < 3; ++repeat) {
        std::vector<std::size_t> order = in_order(objectives.size());
        for (std::size_t k = order.size(); k > 1; --k) std::swap(order[k - 1], order[random.below(k)]);
        if (repeat > 0) order.resize(1 + random.below(std::min<std::size_t>(order.size(), 11)));
        const std::vector<test::Run> runs = minimise(set, centre, objectives, order, options);
        for (const std::size_t k : order) EXPECT_TRUE(same_bits(runs[k], right[k])) << bits << ", " << k;
      }
      const std::size_t alone = random.below(objectives.size());
      EXPECT_TRUE(same_bits(minimise(set, centre, objectives, {alone}, options)[alone], right[alone]))
          << bits;
    }
  }
}

/// Company that goes wrong, here by weights that overflow, is no concern of the other lanes.
TEST(LockStep, DoesNotSufferFromBadCompany) {
  StrengthSet set(zoo::column(6, 0.4, 0.3));
  const AnalyticCentre centre = find_analytic_centre(set.structure, set.cholesky);
  std::vector<Objective> objectives = set.objectives();
  const std::size_t good = objectives.size();
  const std::vector<test::Run> right = minimise(set, centre, objectives, in_order(good), {});
  const double bad[] = {1e308, -1e308, kInfinity, kNaN, 1e-300, 1e-320};
  for (const double weight : bad) objectives.push_back({{0, weight}, {3, -weight}});
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < good; ++k) {
    order.push_back(k);
    if (k % 3 == 0) order.push_back(good + k / 3 % std::size(bad));
  }
  for (const int bits : {128, 512}) {
    LockStepOptions options;
    options.vector_bits = bits;
    const std::vector<test::Run> runs = minimise(set, centre, objectives, order, options);
    for (std::size_t k = 0; k < good; ++k) EXPECT_TRUE(same_bits(runs[k], right[k])) << bits << ", " << k;
    for (std::size_t k = good; k < good + 4; ++k) {
      EXPECT_TRUE(runs[k].finished);
      for (const double x : runs[k].x) EXPECT_TRUE(std::isfinite(x)) << k;
    }
    EXPECT_FALSE(runs[good + 2].converged);
    EXPECT_FALSE(runs[good + 3].converged);
  }
}

TEST(LockStep, EndsAtOnceWhenToldTo) {
  StrengthSet set(zoo::column(6, 0.4, 0.3));
  const AnalyticCentre centre = find_analytic_centre(set.structure, set.cholesky);
  const std::vector<Objective> objectives = set.objectives();
  for (const int patience : {0, 1, 2}) {
    int asked = 0;
    std::size_t next = 0, finished = 0;
    LockStepCalls calls;
    calls.next = [&]() -> std::optional<std::size_t> {
      return next < objectives.size() ? next++ : std::optional<std::size_t>();
    };
    calls.objective = [&](std::size_t k) -> const Objective& { return objectives[k]; };
    calls.finish = [&](const Iterate&) { ++finished; };
    calls.keep_on = [&] { return asked++ < patience; };
    LockStepOptions options;
    options.gap = 1e-8;
    minimise_in_lock_step(set.structure, centre, options, calls);
    EXPECT_EQ(asked, patience + 1);
    EXPECT_EQ(finished, 0U) << "none takes so few iterations";
    EXPECT_EQ(next, 8U) << "a lane each";
  }
}

TEST(LockStep, OfNoObjectivesDoesNothing) {
  StrengthSet set(zoo::wedge(0.5, 0.4));
  const AnalyticCentre centre = find_analytic_centre(set.structure, set.cholesky);
  EXPECT_TRUE(minimise(set, centre, {}, {}, {}).empty());
  const test::Run run = minimise(set, centre, {{}}, {0}, {}).front();  // the sum of nothing is 0
  EXPECT_TRUE(run.converged);
}

TEST(LockStep, OfAnEmptySceneEnds) {
  Packing nothing;
  nothing.named_force_unit = 1;
  StrengthSet set(nothing);
  const AnalyticCentre centre = find_analytic_centre(set.structure, set.cholesky);
  const test::Run run = minimise(set, centre, {{}}, {0}, {}).front();
  EXPECT_TRUE(run.finished);
  EXPECT_TRUE(run.converged);
}

/// A gap that rounding does not allow, or too few iterations: an iterate without the claim.
TEST(LockStep, TellsWhatItDidNotReach) {
  StrengthSet set(zoo::column(6, 0.4, 0.3));
  const AnalyticCentre centre = find_analytic_centre(set.structure, set.cholesky);
  const std::vector<Objective> objectives = set.objectives();
  LockStepOptions exact;
  exact.gap = 0;
  LockStepOptions close;
  close.gap = 1e-9;
  LockStepOptions hasty;
  hasty.most_iterations = 2;
  const std::vector<std::size_t> order = in_order(objectives.size());
  const std::vector<test::Run> right = minimise(set, centre, objectives, order, close);
  const std::vector<test::Run> asked_too_much = minimise(set, centre, objectives, order, exact);
  const std::vector<test::Run> stopped = minimise(set, centre, objectives, order, hasty);
  for (const std::size_t k : order) {
    EXPECT_TRUE(right[k].converged);
    EXPECT_FALSE(asked_too_much[k].converged);
    EXPECT_LE(asked_too_much[k].iterations, exact.most_iterations);
    for (const double x : asked_too_much[k].x) EXPECT_TRUE(std::isfinite(x) && x > 0);
    EXPECT_FALSE(stopped[k].converged);
    EXPECT_EQ(stopped[k].iterations, 2);
    EXPECT_GT(value_of(objectives[k], stopped[k].x), value_of(objectives[k], right[k].x) - 1e-9);
  }
}

TEST(LockStep, ReachesASmallGapInFewIterations) {
  StrengthSet set(zoo::column(30, 0.4, 0.3));
  const AnalyticCentre centre = find_analytic_centre(set.structure, set.cholesky);
  ASSERT_TRUE(centre.found);
  const std::vector<Objective> objectives = set.objectives();
  LockStepOptions options;
  options.gap = 1e-8;
  for (const test::Run& run : minimise(set, centre, objectives, in_order(objectives.size()), options)) {
    EXPECT_TRUE(run.converged);
    EXPECT_LE(run.iterations, 30);
  }
}

}  // namespace
}  // namespace indet::barrier
