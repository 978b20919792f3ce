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
    const FeasibleSet set = test::random_polytope(d, 6, false, random);
    const Basis corner = purify_to_vertex(set, Eigen::VectorXd::Zero(d), Eigen::VectorXd::Ones(d));
    const InteriorStart start =
        leave_sliding_contacts(set, compute_vertex(set, corner).x, tolerance::kSliding);
    ASSERT_EQ(start.end, InteriorEnd::kFound);
    EXPECT_EQ(start.sliding, d);
    EXPECT_EQ(start.left, d);
    EXPECT_GT((set.offset + set.slope * start.z).minCoeff(), tolerance::kSliding);
  }
}

TEST(InteriorStart, KeepsAnInteriorState) {
  Random random(82);
  const FeasibleSet set = test::random_polytope(4, 6, false, random);
  const InteriorStart start = leave_sliding_contacts(set, set.offset, tolerance::kSliding);
  EXPECT_EQ(start.end, InteriorEnd::kFound);
  EXPECT_EQ(start.sliding, 0);
  EXPECT_LT(start.z.norm(), 1e-12);
}

TEST(InteriorStart, TellsWhyThereIsNone) {
  Random random(83);
  const FeasibleSet set = test::random_polytope(3, 4, false, random);
  Eigen::VectorXd unknown = set.offset;
  unknown[2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(leave_sliding_contacts(set, unknown, tolerance::kSliding).end, InteriorEnd::kUnknown);
  Eigen::VectorXd unbalanced = set.offset;
  unbalanced[2] += 0.1;
  EXPECT_EQ(leave_sliding_contacts(set, unbalanced, tolerance::kSliding).end, InteriorEnd::kOutside);
  const Eigen::VectorXd violated = set.offset + set.slope * Eigen::Vector3d(-1.5, 0, 0);
  EXPECT_EQ(leave_sliding_contacts(set, violated, tolerance::kSliding).end, InteriorEnd::kOutside);
}

TEST(InteriorStart, ATightCornerIsReported) {
  // Four planes meet at the tip of a pyramid: none can be left while the other three are kept.
  FeasibleSet set;
  set.slope.resize(5, 3);
  set.slope << 1, 0, 1, -1, 0, 1, 0, 1, 1, 0, -1, 1, 0, 0, -1;
  set.offset.resize(5);
  set.offset << 0, 0, 0, 0, 1;
  const InteriorStart start = leave_sliding_contacts(set, set.offset, tolerance::kSliding);
  EXPECT_EQ(start.end, InteriorEnd::kTightCorner);
  EXPECT_EQ(start.sliding, 4);
  EXPECT_EQ(start.z.size(), 0);
}

}  // namespace
}  // namespace indet
