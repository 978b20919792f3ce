#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <cstdlib>

#include "libindet/range/analyze.h"
#include "tests/support/compare.h"
#include "tests/support/oracle.h"
#include "tests/support/same_cases.h"
#include "tests/support/zoo.h"

namespace indet {
namespace {

struct Scene {
  Packing packing;
  Formulation formulation = Formulation::kDual;
};

/// A pile of a few disks; shrinks to fewer disks and smaller seeds.
Scene any_pile(int most) {
  const auto seed = *rc::gen::inRange<std::uint64_t>(0, 1000000);
  const int count = *rc::gen::inRange(1, most + 1);
  const double mu = *rc::gen::element(-1.0, 0.05, 0.3, 0.7, 2.0);
  const auto formulation = *rc::gen::element(Formulation::kNullSpace, Formulation::kDual, Formulation::kEdge);
  return {zoo::random_pile(seed, count, mu), formulation};
}

ForceRanges analyze(const Scene& scene) {
  AnalyzeOptions options;
  options.formulation = scene.formulation;
  return indet::analyze(scene.packing, options);
}

TEST(Property, RangesAreThoseOfAllVertices) {
  EXPECT_TRUE(rc::check([] {
    const Scene scene = any_pile(4);
    const ForceRanges ranges = analyze(scene);
    const oracle::States states = oracle::enumerate_states(scene.packing);
    RC_ASSERT(ranges.dim == states.dim);
    RC_ASSERT((ranges.status == PolytopeStatus::kUnbounded) == (states.rays.rows() > 0 && states.dim >= 0));
    for (int i = 0; states.dim >= 0 && i < scene.packing.contact_count(); ++i) {
      for (int column = 0; column < 4; ++column) {
        const auto exact =
            oracle::extremum(states, 2 * i + (column >= kMinT ? 1 : 0), column % 2 == 0 ? -1 : 1);
        RC_ASSERT(test::near(exact.value, ranges.value(i, column) / ranges.force_unit, 1e-8));
        if (std::isfinite(exact.value)) RC_ASSERT((ranges.unique(i, column) == 1) == exact.unique);
      }
    }
  }));
}

TEST(Property, StatesAreBalancedAndMotionsFall) {
  EXPECT_TRUE(rc::check([] {
    const Scene scene = any_pile(25);
    const Packing& packing = scene.packing;
    const ForceRanges ranges = analyze(scene);
    RC_CLASSIFY(ranges.status == PolytopeStatus::kEmpty, "empty");
    RC_CLASSIFY(ranges.status == PolytopeStatus::kUnbounded, "unbounded");
    if (ranges.status == PolytopeStatus::kEmpty) {
      RC_ASSERT(bool(test::is_falling_motion(packing, ranges.motion, 1e-8)));
      return;
    }
    RC_ASSERT(ranges.certified == ranges.objectives);
    if (ranges.status == PolytopeStatus::kUnbounded)
      RC_ASSERT(bool(test::has_rays_where_infinite(packing, ranges, 1e-8)));
    const Eigen::MatrixXd c = oracle::paper_matrix(packing);
    const Eigen::VectorXd w = oracle::paper_wrench(packing);
    for (Eigen::Index k = 0; k < ranges.states.rows(); ++k) {
      const Eigen::VectorXd state = ranges.states.row(k).transpose() / ranges.force_unit;
      const double scale = std::max(1.0, state.lpNorm<Eigen::Infinity>());
      RC_ASSERT((c * state + w).lpNorm<Eigen::Infinity>() < 1e-10 * scale);
      for (int i = 0; i < packing.contact_count(); ++i) {
        const double mu = packing[ContactId(i)].mu;
        RC_ASSERT(state[2 * i] > -1e-10 * scale);
        RC_ASSERT(mu * state[2 * i] - std::abs(state[2 * i + 1]) > -1e-10 * scale);
        // No stored state lies outside any range.
        const Eigen::Vector4d range = ranges.value.row(i).matrix().transpose() / ranges.force_unit;
        RC_ASSERT(state[2 * i] > range[kMinR] - 1e-8 * scale && state[2 * i] < range[kMaxR] + 1e-8 * scale);
        RC_ASSERT(state[2 * i + 1] > range[kMinT] - 1e-8 * scale &&
                  state[2 * i + 1] < range[kMaxT] + 1e-8 * scale);
      }
    }
  }));
}

TEST(Property, FormulationsAgree) {
  EXPECT_TRUE(rc::check([] {
    Scene scene = any_pile(14);
    const ForceRanges ranges = analyze(scene);
    for (const Formulation other : {Formulation::kNullSpace, Formulation::kDual, Formulation::kEdge}) {
      scene.formulation = other;
      const testing::AssertionResult same = test::same_ranges(ranges, analyze(scene), 1e-8);
      if (!same) RC_FAIL(same.message());
    }
  }));
}

TEST(Property, MoreFrictionWidensTheRanges) {
  EXPECT_TRUE(rc::check([] {
    Scene scene = any_pile(12);
    const ForceRanges less = analyze(scene);
    for (Contact& contact : scene.packing.contacts) contact.mu *= 1.25;
    const ForceRanges more = analyze(scene);
    if (less.status == PolytopeStatus::kEmpty) return;
    RC_ASSERT(more.status != PolytopeStatus::kEmpty);
    const auto at_most = [](double a, double b) { return a <= b || test::near(a, b, 1e-8); };
    for (Eigen::Index i = 0; i < less.value.rows(); ++i) {
      RC_ASSERT(at_most(more.value(i, kMinR), less.value(i, kMinR)));
      RC_ASSERT(at_most(more.value(i, kMinT), less.value(i, kMinT)));
      RC_ASSERT(at_most(less.value(i, kMaxR), more.value(i, kMaxR)));
      RC_ASSERT(at_most(less.value(i, kMaxT), more.value(i, kMaxT)));
    }
  }));
}

}  // namespace
}  // namespace indet
