#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "libindet/base/error.h"
#include "libindet/range/analyze.h"
#include "libindet/range/drop_states.h"
#include "tests/support/compare.h"
#include "tests/support/zoo.h"

namespace indet {
namespace {

using Kind = StateChoice::Kind;
using Contacts = StateChoice::Contacts;

/// Bounded, unbounded, of several blocks, a point, empty, degenerate, random.
std::vector<Packing> packings() {
  std::vector<Packing> all = {zoo::wedge(0.5, 0.3),
                              zoo::pinched_disk(0.4),
                              zoo::column_between_walls(3, 0.4),
                              zoo::two_wedges(0.5, 0.3, 0.4, 0.2),
                              zoo::wedge_and_corner(0.5, 0.3),
                              zoo::disk_on_floor(0.3),
                              zoo::disk_on_incline(0.2, 0.3),
                              zoo::column(4, 0.4, 0.1),
                              zoo::lattice_pile(3, 0.5)};
  for (const std::uint64_t seed : {1, 2, 3}) all.push_back(zoo::random_pile(seed, 14, 0.5));
  return all;
}

ForceRanges analyze_keeping(const Packing& packing, const StateChoice& states, Method method = Method::kLp,
                            int threads = 1) {
  AnalyzeOptions options;
  options.method = method;
  options.states = states;
  options.threads = threads;
  return analyze(packing, options);
}

/// What is told of the values, without their states.
void expect_same_values(const ForceRanges& a, const ForceRanges& b) {
  EXPECT_TRUE(test::same_entries(a.value, b.value, 0));
  EXPECT_TRUE(test::same_entries(a.lower, b.lower, 0));
  EXPECT_TRUE(test::same_entries(a.upper, b.upper, 0));
  EXPECT_TRUE(test::same_entries(a.sensitivity.value, b.sensitivity.value, 0));
  EXPECT_TRUE(test::same_entries(a.primal_residual, b.primal_residual, 0));
  EXPECT_TRUE(test::same_entries(a.dual_residual, b.dual_residual, 0));
  EXPECT_TRUE((a.outcome == b.outcome).all());
  EXPECT_TRUE((a.unique == b.unique).all());
  EXPECT_EQ(a.residual, b.residual);
  EXPECT_EQ(a.doubtful, b.doubtful);
}

/// Each value is that of its state, and d that of the two states.
void expect_states_fit(const ForceRanges& ranges) {
  for (Eigen::Index i = 0; i < ranges.vertex.rows(); ++i) {
    for (int column = 0; column < 4; ++column) {
      const int row = ranges.vertex(i, column);
      const bool has_state = ranges.keeps(static_cast<int>(i)) && std::isfinite(ranges.value(i, column));
      ASSERT_EQ(row >= 0, has_state) << i << " " << column;
      if (!has_state) continue;
      EXPECT_EQ(ranges.value(i, column), ranges.states(row, 2 * i + (column >= kMinT ? 1 : 0)));
    }
    if (!ranges.keeps(static_cast<int>(i))) {
      EXPECT_TRUE(std::isnan(ranges.d_R[i]));
      EXPECT_TRUE(std::isnan(ranges.d_T[i]));
    }
  }
  EXPECT_EQ(ranges.norm.size(), ranges.states.rows());
  EXPECT_EQ(ranges.active.rows(), ranges.states.rows());
}

TEST(KeptStates, ValuesStandWithoutThem) {
  int number = 0;
  for (const Packing& packing : packings()) {
    for (const Method method : kVertexMethods) {
      SCOPED_TRACE(std::to_string(number++) + " " + to_string(method));
      const ForceRanges none = analyze_keeping(packing, {.kind = Kind::kNone}, method);
      EXPECT_EQ(none.state_kind, Kind::kNone);
      EXPECT_EQ(none.states.rows(), 0);
      EXPECT_EQ(none.active.rows(), 0);
      EXPECT_EQ(none.largest_norm, -1);
      EXPECT_TRUE((none.vertex == -1).all());
      EXPECT_TRUE(none.d_R.array().isNaN().all());
      expect_same_values(analyze_keeping(packing, {.kind = Kind::kSolver}, method), none);
      const ForceRanges canonical = analyze_keeping(packing, {.kind = Kind::kCanonical}, method);
      EXPECT_TRUE(test::same_entries(canonical.value, none.value, 1e-10));
      // The search for canonical states proves some values at which a walk stopped without proof.
      if (method == Method::kPivotingPaper) {
        EXPECT_LE(canonical.imprecise, none.imprecise);
      } else {
        EXPECT_TRUE((canonical.outcome == none.outcome).all());
      }
      for (Eigen::Index k = 0; k < none.value.size(); ++k) {
        const Eigen::Index i = k / 4;
        if (std::isnan(none.value(i, k % 4))) continue;
        EXPECT_LE(none.lower(i, k % 4), canonical.upper(i, k % 4));
        EXPECT_GE(none.upper(i, k % 4), canonical.lower(i, k % 4));
      }
    }
  }
}

TEST(KeptStates, OfSomeContactsAreThoseOfAll) {
  int number = 0;
  for (const Packing& packing : packings()) {
    if (packing.contact_count() < 2) continue;
    for (const Method method : kVertexMethods) {
      SCOPED_TRACE(std::to_string(number++) + " " + to_string(method));
      for (const Kind kind : {Kind::kSolver, Kind::kCanonical}) {
        const ForceRanges all = analyze_keeping(packing, {.kind = kind}, method);
        expect_states_fit(all);
        StateChoice choice{.kind = kind, .contacts = Contacts::kList, .list = {1, 0, 1}};
        const ForceRanges some = analyze_keeping(packing, choice, method);
        expect_states_fit(some);
        if (some.status == PolytopeStatus::kEmpty) continue;
        EXPECT_EQ(some.state_contacts.size(), 2);
        EXPECT_TRUE(test::same_entries(all.value, some.value, 1e-10));
        for (const int i : {0, 1}) {
          EXPECT_TRUE(test::near(all.d_R[i], some.d_R[i], 1e-7));
          EXPECT_TRUE(test::near(all.d_T[i], some.d_T[i], 1e-7));
          for (int column = 0; column < 4; ++column) {
            if (all.vertex(i, column) < 0) continue;
            EXPECT_TRUE(test::same_entries(all.states.row(all.vertex(i, column)),
                                           some.states.row(some.vertex(i, column)),
                                           kind == Kind::kSolver ? 0 : 1e-7));
          }
        }
      }
    }
  }
}

TEST(KeptStates, OfTheLargest) {
  const Packing packing = zoo::random_pile(2, 14, 0.5);
  const ForceRanges all = analyze_keeping(packing, {.kind = Kind::kSolver});
  const StateChoice choice{.kind = Kind::kSolver, .contacts = Contacts::kLargest, .largest = 3};
  const ForceRanges some = analyze_keeping(packing, choice);
  expect_states_fit(some);
  expect_same_values(all, some);
  ASSERT_EQ(some.state_contacts.size(), 3);
  const Eigen::VectorXd size = all.delta_R + all.delta_T;
  double least = size.maxCoeff();
  for (const int i : some.state_contacts) least = std::min(least, size[i]);
  EXPECT_EQ((size.array() > least).count(), 2);

  const ForceRanges dropped = drop_states(all, choice);
  expect_states_fit(dropped);
  EXPECT_TRUE((dropped.state_contacts == some.state_contacts).all());
  EXPECT_EQ(dropped.states.rows(), some.states.rows());
  EXPECT_TRUE(test::same_entries(dropped.d_R, some.d_R, 0));
  EXPECT_EQ(dropped.norm[dropped.largest_norm], some.norm[some.largest_norm]);
  const ForceRanges none = drop_states(all, {.kind = Kind::kNone});
  EXPECT_EQ(none.states.rows(), 0);
  EXPECT_EQ(none.largest_norm, -1);
  EXPECT_TRUE((none.vertex == -1).all());
}

TEST(KeptStates, AnUnboundedContactIsTheLargest) {
  const ForceRanges ranges =
      analyze_keeping(zoo::pinched_disk(0.4), {.contacts = Contacts::kLargest, .largest = 1});
  ASSERT_EQ(ranges.state_contacts.size(), 1);
  expect_states_fit(ranges);
}

TEST(KeptStates, DoNotDependOnTheNumberOfThreads) {
  const Packing packing = zoo::random_pile(1, 14, 0.5);
  for (const StateChoice& choice :
       {StateChoice{.kind = Kind::kNone}, StateChoice{.contacts = Contacts::kLargest, .largest = 4}}) {
    const ForceRanges one = analyze_keeping(packing, choice);
    EXPECT_TRUE(test::same_bytes(one, analyze_keeping(packing, choice, Method::kLp, 3)));
  }
}

TEST(StateChoice, IsLimitedBySize) {
  const StateChoice standard;
  EXPECT_EQ(limited(standard, 1250).kind, Kind::kCanonical);
  EXPECT_EQ(limited(standard, 1251).kind, Kind::kNone);
  EXPECT_EQ(limited({.within_limit = false}, 2726).kind, Kind::kCanonical);
  EXPECT_EQ(limited({.contacts = Contacts::kLargest, .largest = 5}, 2726).kind, Kind::kCanonical);
}

TEST(StateChoice, TellsItsDefects) {
  const std::vector<int> asked = {0, 2, 3};
  EXPECT_FALSE(StateChoice{}.defect(asked));
  EXPECT_FALSE((StateChoice{.contacts = Contacts::kList, .list = {3, 0}}.defect(asked)));
  const auto says = [&](const StateChoice& choice, const std::string& text) {
    const auto defect = choice.defect(asked);
    return defect && defect->find(text) != std::string::npos;
  };
  EXPECT_TRUE(says({.contacts = Contacts::kList, .list = {1}}, "contact 1"));
  EXPECT_TRUE(says({.contacts = Contacts::kList}, "no contact"));
  EXPECT_TRUE(says({.contacts = Contacts::kLargest}, "at least 1"));
  EXPECT_TRUE(says({.kind = Kind::kNone, .contacts = Contacts::kLargest, .largest = 1}, "none"));
  EXPECT_TRUE(says({.kind = Kind::kUnknown}, "not said"));
  AnalyzeOptions options;
  options.states = {.contacts = Contacts::kList, .list = {99}};
  EXPECT_THROW(analyze(zoo::wedge(0.5, 0.3), options), InputError);
}

TEST(StateChoice, LargestContactsHaveAValue) {
  Table4<double> value(4, 4);
  value << 0, 1, 0, 1, 0, 3, 0, 0, 0, std::nan(""), 0, 1, 0, 2, 0, 1;
  const StateChoice two{.contacts = Contacts::kLargest, .largest = 2};
  EXPECT_EQ(contacts_with_states(two, value), (std::vector<int>{1, 3})) << "of equals the first";
  const StateChoice many{.contacts = Contacts::kLargest, .largest = 9};
  EXPECT_EQ(contacts_with_states(many, value), (std::vector<int>{0, 1, 3}));
}

}  // namespace
}  // namespace indet
