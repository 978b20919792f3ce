#include "libindet/range/method.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <cstdlib>
#include <set>
#include <string>
#include <vector>

#include "libindet/range/analyze.h"
#include "tests/support/compare.h"
#include "tests/support/oracle.h"
#include "tests/support/same_cases.h"
#include "tests/support/zoo.h"

namespace indet {
namespace {

ForceRanges analyze_by(Method method, const Packing& packing, int threads = 1) {
  AnalyzeOptions options;
  options.method = method;
  options.threads = threads;
  return analyze(packing, options);
}

/// By the paper's method, as each of its options has it.
std::vector<PaperOptions> all_paper_options() {
  std::vector<PaperOptions> all;
  for (const NeighbourRule rule : kNeighbourRules) {
    for (const WalkStart start : kWalkStarts) all.push_back({rule, start, 5});
  }
  return all;
}

ForceRanges walk_by(const PaperOptions& paper, const Packing& packing, bool canonical_states = true,
                    int threads = 1) {
  AnalyzeOptions options;
  options.method = Method::kPivotingPaper;
  options.paper = paper;
  if (!canonical_states) options.states.kind = StateChoice::Kind::kSolver;
  options.threads = threads;
  return analyze(packing, options);
}

/// What must hold of the paper's method: every value is right, or marked.
void expect_right_or_marked(const ForceRanges& right, const ForceRanges& ranges) {
  ASSERT_EQ(right.status, ranges.status);
  ASSERT_EQ(right.dim, ranges.dim);
  for (Eigen::Index i = 0; i < right.value.rows(); ++i) {
    for (int column = 0; column < 4; ++column) {
      SCOPED_TRACE("contact " + std::to_string(i) + ", " + to_string(static_cast<Column>(column)));
      if (ranges.outcome(i, column) == Outcome::kImprecise) continue;
      if (ranges.outcome(i, column) == Outcome::kFailed) {
        EXPECT_TRUE(std::isnan(ranges.value(i, column)));
        continue;
      }
      EXPECT_EQ(right.outcome(i, column), ranges.outcome(i, column));
      EXPECT_TRUE(test::near(right.value(i, column), ranges.value(i, column), 1e-8))
          << right.value(i, column) << " " << ranges.value(i, column) << ", dual residual "
          << ranges.dual_residual(i, column);
    }
  }
  EXPECT_LE(ranges.failed + ranges.imprecise, ranges.paper.failures());
}

std::vector<Packing> simple_scenes() {
  return {zoo::wedge(0.5, 0.3),
          zoo::wedge(1.4, 0.3),
          zoo::wedge(0, 0.3),
          zoo::disk_on_floor(0.3),
          zoo::disk_on_incline(0.2, 1),
          zoo::pyramid(0.8, 0.6, 0.6),
          zoo::column(6, 0.4, 0.3),
          zoo::pinched_disk(0.25),
          zoo::two_wedges(0.4, 0.3, 0.9, 0.5),
          zoo::two_wedges(1.4, 0.3, 0.4, 0.3),
          zoo::corner(0.4, 1.5),
          zoo::wedge_and_corner(0.5, 0.3),
          zoo::wedge_and_loose_disk(0.5, 0.3, 0),
          zoo::lattice_pile(3, 0.6),
          zoo::lattice_pile(5, 0.4),
          zoo::lattice_pile(6, 0.9),
          zoo::frictionless_column(5, 0.5)};
}

TEST(Methods, TheTableauGivesTheSameResultsInTheZoo) {
  int number = 0;
  for (const Packing& packing : simple_scenes()) {
    SCOPED_TRACE(number++);
    const ForceRanges lp = analyze_by(Method::kLp, packing);
    EXPECT_TRUE(test::same_ranges_and_weights(lp, analyze_by(Method::kPivotingTableau, packing), 1e-8));
  }
}

TEST(Methods, ThePaperIsRightOrSaysSoInTheZoo) {
  int number = 0;
  for (const Packing& packing : simple_scenes()) {
    SCOPED_TRACE(number++);
    const ForceRanges lp = analyze_by(Method::kLp, packing);
    for (const PaperOptions& paper : all_paper_options()) {
      SCOPED_TRACE(std::string(to_string(paper.neighbour)) + ", " + to_string(paper.start));
      expect_right_or_marked(lp, walk_by(paper, packing));
    }
  }
}

TEST(Methods, TheTableauGivesTheSameResultsInPiles) {
  EXPECT_TRUE(rc::check([] {
    const Packing packing =
        zoo::random_pile(*rc::gen::inRange<std::uint64_t>(0, 1000000), *rc::gen::inRange(1, 15),
                         *rc::gen::element(-1.0, 0.05, 0.3, 0.7, 2.0));
    const ForceRanges lp = analyze_by(Method::kLp, packing);
    RC_ASSERT(bool(test::same_ranges(lp, analyze_by(Method::kPivotingTableau, packing), 1e-8)));
  }));
}

TEST(Methods, ThePaperIsRightOrSaysSoInPiles) {
  EXPECT_TRUE(rc::check([] {
    const Packing packing =
        zoo::random_pile(*rc::gen::inRange<std::uint64_t>(0, 1000000), *rc::gen::inRange(1, 12),
                         *rc::gen::element(-1.0, 0.05, 0.3, 0.7, 2.0));
    const ForceRanges lp = analyze_by(Method::kLp, packing);
    for (const PaperOptions& options : all_paper_options()) {
      const ForceRanges paper = walk_by(options, packing);
      RC_CLASSIFY(paper.paper.failures() > 0, "with failures");
      expect_right_or_marked(lp, paper);
    }
    RC_ASSERT(!testing::Test::HasFailure());
  }));
}

// The ensemble compares both, and does not search twice.
TEST(Methods, TellTheStatesOfASearchWithoutCanonicalOnes) {
  int number = 0;
  int others = 0;
  std::vector<Packing> packings = simple_scenes();
  for (const std::uint64_t seed : {1, 2}) packings.push_back(zoo::random_pile(seed, 14, 0.5));
  for (const Packing& packing : packings) {
    for (const Method method : {Method::kLp, Method::kPivotingTableau, Method::kPivotingPaper}) {
      SCOPED_TRACE(std::to_string(number++) + " " + to_string(method));
      AnalyzeOptions options;
      options.method = method;
      options.solver_states = true;
      options.exact_work = 0;  // exact searches land nowhere
      const ForceRanges both = analyze(packing, options);
      options.solver_states = false;
      options.states.kind = StateChoice::Kind::kSolver;
      const ForceRanges landed = analyze(packing, options);
      EXPECT_FALSE(landed.solver_states);
      ASSERT_TRUE(both.solver_states);
      EXPECT_TRUE((both.solver_states->vertex == landed.vertex).all());
      ASSERT_EQ(both.solver_states->states.rows(), landed.states.rows());
      EXPECT_EQ(both.solver_states->states, landed.states);
      const StateDistances distances =
          state_distances(both.solver_states->states, both.solver_states->vertex, both.force_unit);
      EXPECT_TRUE(test::same_entries(distances.d_R, landed.d_R, 0));
      EXPECT_TRUE(test::same_entries(distances.d_T, landed.d_T, 0));
      others += both.states.rows() == landed.states.rows() ? 0 : 1;
      ForceRanges canonical = both;
      canonical.solver_states.reset();
      EXPECT_TRUE(test::same_bytes(analyze_by(method, packing), canonical))
          << "the canonical states stay the same";
    }
  }
  EXPECT_GT(others, 10);
}

TEST(Methods, FailuresOfThePaperAreCounted) {
  // Many inequalities meet in the extremal points of a lattice.
  const ForceRanges ranges = analyze_by(Method::kPivotingPaper, zoo::lattice_pile(6, 0.9));
  const PaperWork& work = ranges.paper;
  EXPECT_GT(work.walks[static_cast<std::size_t>(WalkEnd::kMoreActive)], 0);
  EXPECT_GE(work.failures(), work.walks[static_cast<std::size_t>(WalkEnd::kMoreActive)]);
  EXPECT_EQ(work.walk_count(), ranges.objectives - ranges.determined);
  EXPECT_GT(work.unexpected, 0);
  EXPECT_LT(work.neighbours, work.points * ranges.dim) << "not all, where one of the first is better";
  EXPECT_GE(work.neighbours, work.walk_count() * ranges.dim) << "but all of where a walk ends";
  const PaperWork best = walk_by({.neighbour = NeighbourRule::kBest}, zoo::lattice_pile(6, 0.9)).paper;
  EXPECT_EQ(best.neighbours, best.points * ranges.dim);
  EXPECT_LT(best.points, work.points);
  EXPECT_EQ(work.fallbacks(), 1) << "the pile has no simulated forces";
}

TEST(Methods, ThePaperStartsFromTheSimulatedState) {
  Packing packing = zoo::column(6, 0.4, 0.3);
  const ForceRanges lp = analyze_by(Method::kLp, packing);
  ASSERT_EQ(lp.status, PolytopeStatus::kBounded);
  // An extremal state, in which as many contacts slide as F has dimensions.
  for (int i = 0; i < packing.contact_count(); ++i) {
    Contact& contact = packing.contacts[static_cast<std::size_t>(i)];
    contact.R = lp.states(0, 2 * i);
    contact.T = lp.states(0, 2 * i + 1);
  }
  const ForceRanges ranges = analyze_by(Method::kPivotingPaper, packing);
  const PaperWork& work = ranges.paper;
  EXPECT_EQ(work.fallbacks(), 0);
  EXPECT_EQ(work.starts[static_cast<std::size_t>(InteriorEnd::kFound)], lp.blocks);
  EXPECT_EQ(work.sliding_left, lp.dim);
  expect_right_or_marked(lp, ranges);
}

// dR and dT of the walk, which depend on where it ends.
TEST(Methods, TheStatesOfTheWalkAreThoseOfItsOptions) {
  Packing packing;
  for (std::uint64_t seed = 1; seed < 50; ++seed) {
    packing = zoo::random_pile(seed, 20, 0.3);
    const ForceRanges lp = analyze_by(Method::kLp, packing);
    if (lp.status == PolytopeStatus::kBounded && lp.dim > 8) break;
  }
  std::set<double> sums;
  for (const PaperOptions& options : all_paper_options()) {
    const ForceRanges ranges = walk_by(options, packing, false);
    ASSERT_EQ(ranges.status, PolytopeStatus::kBounded);
    EXPECT_EQ(ranges.paper_options.neighbour, options.neighbour);
    EXPECT_EQ(ranges.paper_options.start, options.start);
    EXPECT_TRUE(test::same_bytes(ranges, walk_by(options, packing, false)));
    EXPECT_TRUE(test::same_bytes(ranges, walk_by(options, packing, false, 3)));
    sums.insert(ranges.d_R.sum());
    for (Eigen::Index i = 0; i < ranges.value.rows(); ++i) {
      const Eigen::VectorXd step =
          (ranges.states.row(ranges.vertex(i, kMaxR)) - ranges.states.row(ranges.vertex(i, kMinR))) /
          ranges.force_unit;
      EXPECT_NEAR(step.norm(), ranges.d_R[i], 1e-9 * (1 + ranges.d_R[i]));
      EXPECT_GE(ranges.d_R[i], ranges.delta_R[i] * (1 - 1e-9)) << "the contact's own force is part of it";
    }
  }
  EXPECT_EQ(sums.size(), all_paper_options().size());
}

TEST(Methods, ThreadsDoNotChangeTheResult) {
  const Packing packing = zoo::random_pile(7, 20, 0.5);
  for (const Method method : {Method::kPivotingPaper, Method::kPivotingTableau}) {
    const ForceRanges one = analyze_by(method, packing, 1);
    EXPECT_TRUE(test::same_bytes(one, analyze_by(method, packing, 3))) << to_string(method);
  }
}

}  // namespace
}  // namespace indet
