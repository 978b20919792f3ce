#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "libindet/base/error.h"
#include "libindet/base/random.h"
#include "libindet/range/analyze.h"
#include "tests/range/formulations.h"
#include "tests/support/compare.h"
#include "tests/support/zoo.h"

namespace indet {
namespace {

/// Larger than what can be enumerated: redundant ways to one answer.
std::vector<std::pair<std::string, Packing>> scenes() {
  std::vector<std::pair<std::string, Packing>> result = {
      {"groove", zoo::wedge(0.4, 0.3)},
      {"jammed groove", zoo::wedge(1.4, 0.3)},
      {"corner", zoo::corner(0.4, 1)},
      {"groove and corner", zoo::wedge_and_corner(0.4, 0.3)},
      {"half jammed", zoo::two_wedges(1.4, 0.3, 0.5, 0.3)},
      {"column", zoo::column(6, 0.5, 0.3)},
      {"tall column", zoo::column(20, 0.3, 0.2)},
      {"lattice", zoo::lattice_pile(4, 0.6)}};
  for (std::uint64_t seed = 100; seed < 112; ++seed)
    result.emplace_back("pile " + std::to_string(seed), zoo::random_pile(seed, 12, seed % 3 == 0 ? -1 : 0.5));
  return result;
}

TEST(Invariance, FormulationsAgree) {
  for (const auto& [name, packing] : scenes()) {
    const ForceRanges dual = analyze_by(Formulation::kDual, packing);
    EXPECT_EQ(dual.imprecise + dual.failed, 0) << name;
    EXPECT_TRUE(test::same_ranges(dual, analyze_by(Formulation::kNullSpace, packing), 1e-9)) << name;
    EXPECT_TRUE(test::same_ranges(dual, analyze_by(Formulation::kEdge, packing), 1e-9)) << name;
  }
}

TEST(Invariance, ThreadsDoNotChangeAByte) {
  for (const auto& [name, packing] : scenes()) {
    for (const Formulation formulation : kFormulations) {
      const ForceRanges one = analyze_by(formulation, packing, 1);
      for (const int threads : {2, 3})
        EXPECT_TRUE(test::same_bytes(one, analyze_by(formulation, packing, threads)))
            << name << ", " << to_string(formulation) << ", " << threads << " threads";
    }
  }
}

TEST(Invariance, RepeatedAnalysesAreTheSame) {
  const Packing packing = zoo::random_pile(101, 12, 0.5);
  EXPECT_TRUE(test::same_bytes(analyze(packing), analyze(packing)));
}

TEST(Invariance, OrderOfDisksAndContactsDoesNotMatter) {
  Random random(21);
  for (const auto& [name, packing] : scenes()) {
    const ForceRanges ranges = analyze(packing);
    for (int repeat = 0; repeat < 2; ++repeat) {
      const std::vector<int> disks = zoo::random_order(packing.disk_count(), random);
      const std::vector<int> contacts = zoo::random_order(packing.contact_count(), random);
      EXPECT_TRUE(test::same_ranges(test::permuted(ranges, contacts),
                                    analyze(zoo::permuted(packing, disks, contacts)), 1e-9))
          << name;
    }
  }
}

TEST(Invariance, EitherBodyOfAContactMayComeFirst) {
  for (const auto& [name, packing] : scenes())
    EXPECT_TRUE(test::same_ranges(analyze(packing), analyze(zoo::with_bodies_swapped(packing)), 1e-9))
        << name;
}

TEST(Invariance, MirroredPackingsHaveReversedTangentialForces) {
  for (const auto& [name, packing] : scenes()) {
    const ForceRanges expected = test::mirrored(analyze(packing));
    const ForceRanges found = analyze(zoo::mirrored(packing));
    EXPECT_TRUE(test::same_ranges_and_weights(expected, found, 1e-9)) << name;
    // The lattice has states of equal total normal force; the choice between them knows left from right.
    if (name != "lattice") {
      EXPECT_TRUE(test::same_ranges(expected, found, 1e-9)) << name;
    }
  }
}

TEST(Invariance, RotatedPackingsHaveTheSameForces) {
  for (const auto& [name, packing] : scenes())
    EXPECT_TRUE(test::same_ranges(analyze(packing), analyze(zoo::rotated(packing, 2.1)), 1e-8)) << name;
}

TEST(Invariance, UnitsThatArePowersOfTwoChangeNoBit) {
  for (const auto& [name, packing] : scenes()) {
    for (const auto& [length, mass, acceleration] :
         {std::tuple(0x1p-7, 0x1p20, 0x1p3), std::tuple(0x1p30, 0x1p-40, 0x1p-2)}) {
      const ForceRanges other = analyze(zoo::rescaled(packing, length, mass, acceleration));
      const ForceRanges expected = test::rescaled(analyze(packing), mass * acceleration);
      EXPECT_TRUE(test::same_bytes(expected, other)) << name;
    }
  }
}

TEST(Invariance, OtherUnitsGiveTheSameForces) {
  for (const auto& [name, packing] : scenes())
    EXPECT_TRUE(
        test::same_ranges(analyze(packing), analyze(zoo::rescaled(packing, 1.7e-3, 2.9e-6, 9.81)), 1e-8))
        << name;
}

TEST(Invariance, ArbitraryStatesHaveTheSameValues) {
  for (const auto& [name, packing] : scenes()) {
    AnalyzeOptions options;
    options.states.kind = StateChoice::Kind::kSolver;
    const ForceRanges any = analyze(packing, options);
    const ForceRanges canonical = analyze(packing);
    EXPECT_TRUE(test::same_entries(canonical.value.matrix(), any.value.matrix(), 1e-9)) << name;
    EXPECT_LE(any.solves, canonical.solves) << name;
    for (Eigen::Index i = 0; i < any.vertex.size(); ++i) {
      const int state = any.vertex.data()[i];
      if (state < 0) continue;
      const Eigen::Index component = 2 * (i / 4) + (i % 4 >= kMinT ? 1 : 0);
      EXPECT_EQ(any.states(state, component), any.value.data()[i]);
    }
  }
}

TEST(Invariance, ProgressOnlyGoesForwardAndCanStopTheAnalysis) {
  std::int64_t most = 0;
  for (const auto& [name, packing] : scenes()) {
    const ForceRanges ranges = analyze(packing);
    if (ranges.status == PolytopeStatus::kEmpty) continue;  // nothing to search
    AnalyzeOptions options;
    std::int64_t last = 0;
    std::string stage;
    options.progress = [&](const Progress& progress) {
      if (progress.stage != stage) last = 0;
      stage = progress.stage;
      EXPECT_GE(progress.done, last);
      EXPECT_LE(progress.done, progress.total);
      last = progress.done;
      most = std::max(most, last);
      return true;
    };
    EXPECT_TRUE(test::same_bytes(ranges, analyze(packing, options))) << name;
    for (const int threads : {1, 2}) {
      options.threads = threads;
      options.progress = [](const Progress&) { return false; };
      EXPECT_THROW(analyze(packing, options), Interrupted) << name;
    }
  }
  EXPECT_GT(most, 20);
}

TEST(Invariance, MeasuresFollowFromTheRanges) {
  Packing packing = zoo::lattice_pile(4, 0.6);
  const ForceRanges before = analyze(packing);
  ASSERT_EQ(before.status, PolytopeStatus::kBounded);
  EXPECT_EQ(before.sliding, -1);
  // Take an extremal state for the simulated one.
  const Eigen::VectorXd state = before.states.row(before.vertex(3, kMaxR));
  for (int k = 0; k < packing.contact_count(); ++k) {
    packing.contacts[static_cast<std::size_t>(k)].R = state[2 * k];
    packing.contacts[static_cast<std::size_t>(k)].T = state[2 * k + 1];
  }
  const ForceRanges ranges = analyze(packing);
  EXPECT_NEAR(ranges.R_star[3], 1, 1e-9);
  EXPECT_GE(ranges.sliding, ranges.dim) << "a vertex has at least dim F active half-planes";
  for (int k = 0; k < packing.contact_count(); ++k) {
    const double unit = ranges.force_unit;
    EXPECT_NEAR(ranges.delta_R[k] * unit, ranges.value(k, kMaxR) - ranges.value(k, kMinR), 1e-12);
    EXPECT_NEAR(ranges.delta_T[k] * unit, ranges.value(k, kMaxT) - ranges.value(k, kMinT), 1e-12);
    EXPECT_GE(ranges.d_R[k], ranges.delta_R[k] - 1e-12);
    EXPECT_GE(ranges.d_T[k], ranges.delta_T[k] - 1e-12);
    if (ranges.delta_R[k] > 1e-9) {
      EXPECT_GE(ranges.R_star[k], -1e-9);
      EXPECT_LE(ranges.R_star[k], 1 + 1e-9);
    }
  }
  EXPECT_EQ(ranges.norm.size(), ranges.states.rows());
  EXPECT_EQ(ranges.norm[ranges.largest_norm], ranges.norm.maxCoeff());
}

}  // namespace
}  // namespace indet
