#include "libindet/pivoting/interior_start.h"

#include <gtest/gtest.h>

#include <limits>

#include "libindet/base/random.h"
#include "libindet/base/tolerances.h"
#include "libindet/lp/purification.h"
#include "libindet/lp/vertex.h"
#include "tests/support/sets.h"

namespace indet {
namespace {

TEST(InteriorStart, LeavesEveryConstraintOfAVertex) {
  Random random(81);
  for (int repeat = 0; repeat < 40; ++repeat) {
    const int d = 1 + static_cast<int>(random.below(6));
    const SlopeView view = test::random_polytope(d, 6, false, random);
    const Basis corner = purify_to_vertex(view, Eigen::VectorXd::Zero(d), Eigen::VectorXd::Ones(d));
    const InteriorStart start =
        leave_sliding_contacts(view, compute_vertex(view, corner).x, tolerance::kSliding);
    ASSERT_EQ(start.end, InteriorEnd::kFound);
    EXPECT_EQ(start.sliding, d);
    EXPECT_EQ(start.left, d);
    EXPECT_GT((view.offset + view.slope * start.z).minCoeff(), tolerance::kSliding);
  }
}

TEST(InteriorStart, KeepsAnInteriorState) {
  Random random(82);
  const SlopeView view = test::random_polytope(4, 6, false, random);
  const InteriorStart start = leave_sliding_contacts(view, view.offset, tolerance::kSliding);
  EXPECT_EQ(start.end, InteriorEnd::kFound);
  EXPECT_EQ(start.sliding, 0);
  EXPECT_LT(start.z.norm(), 1e-12);
}

TEST(InteriorStart, TellsWhyThereIsNone) {
  Random random(83);
  const SlopeView view = test::random_polytope(3, 4, false, random);
  Eigen::VectorXd unknown = view.offset;
  unknown[2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(leave_sliding_contacts(view, unknown, tolerance::kSliding).end, InteriorEnd::kUnknown);
  Eigen::VectorXd unbalanced = view.offset;
  unbalanced[2] += 0.1;
  EXPECT_EQ(leave_sliding_contacts(view, unbalanced, tolerance::kSliding).end, InteriorEnd::kOutside);
  const Eigen::VectorXd violated = view.offset + view.slope * Eigen::Vector3d(-1.5, 0, 0);
  EXPECT_EQ(leave_sliding_contacts(view, violated, tolerance::kSliding).end, InteriorEnd::kOutside);
}

TEST(InteriorStart, ATightCornerIsReported) {
  // Four planes meet at the tip of a pyramid: none can be left while the other three are kept.
  SlopeView view;
  view.slope.resize(5, 3);
  view.slope << 1, 0, 1, -1, 0, 1, 0, 1, 1, 0, -1, 1, 0, 0, -1;
  view.offset.resize(5);
  view.offset << 0, 0, 0, 0, 1;
  const InteriorStart start = leave_sliding_contacts(view, view.offset, tolerance::kSliding);
  EXPECT_EQ(start.end, InteriorEnd::kTightCorner);
  EXPECT_EQ(start.sliding, 4);
  EXPECT_EQ(start.z.size(), 0);
}

}  // namespace
}  // namespace indet
