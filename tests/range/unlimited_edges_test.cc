#include "libindet/range/unlimited_edges.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "tests/support/zoo.h"

namespace indet {
namespace {

using Forces = std::vector<std::pair<int, double>>;

/// A row of disks between two walls, on a floor: R of all contacts along the row grow together, by the same.
class UnlimitedEdgesOfARow : public ::testing::Test {
 protected:
  static constexpr int kDisks = 4;
  Packing packing_ = zoo::row_between_walls(kDisks, 0.5);
  ForcePolytope polytope_ = find_force_polytope(packing_);
  DoubledEquations equations_{polytope_};
  UnlimitedEdges unlimited_{polytope_};

  bool is_along_row(int contact) const { return std::abs(packing_[ContactId(contact)].normal.x()) > 0.5; }
};

TEST_F(UnlimitedEdgesOfARow, AreThoseOfItsContacts) {
  ASSERT_TRUE(unlimited_.any());
  for (int k = 0; k < polytope_.problem.unknowns(); ++k)
    EXPECT_EQ(unlimited_.contains(k), is_along_row(polytope_.problem.edge(k).contact.value())) << k;
}

TEST_F(UnlimitedEdgesOfARow, ForcesThatDoNotGrowAreLevel) {
  std::vector<int> along;
  for (int contact = 0; contact < packing_.contact_count(); ++contact) {
    EXPECT_EQ(unlimited_.is_level(Forces{{2 * contact, 1.0}}), !is_along_row(contact)) << contact;
    EXPECT_TRUE(unlimited_.is_level(Forces{{2 * contact + 1, 1.0}})) << contact;
    if (is_along_row(contact)) along.push_back(contact);
  }
  ASSERT_EQ(along.size(), kDisks + 1);
  EXPECT_TRUE(unlimited_.is_level(Forces{{2 * along[0], 1.0}, {2 * along[1], -1.0}})) << "they grow alike";
  EXPECT_FALSE(unlimited_.is_level(Forces{{2 * along[0], 1.0}, {2 * along[1], -0.5}}));
}

/// Multipliers that rounding has left with h of 1e-16 are moved by little, and by nothing where h is 0.
TEST_F(UnlimitedEdgesOfARow, ShiftIsInProportionToWhatIsLeft) {
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(equations_.columns());
  EXPECT_EQ(unlimited_.shift({zero, zero}), 0);
  const double once = unlimited_.shift({zero, Eigen::VectorXd::Constant(equations_.columns(), 1e-16)});
  EXPECT_GT(once, 1e-17);
  EXPECT_LT(once, 1e-14);
  EXPECT_NEAR(unlimited_.shift({zero, Eigen::VectorXd::Constant(equations_.columns(), 3e-16)}), 3 * once,
              1e-9 * once);
}

TEST(UnlimitedEdges, ThereAreNoneWhereForcesAreBounded) {
  const ForcePolytope polytope = find_force_polytope(zoo::lattice_pile(3, 0.6));
  ASSERT_EQ(polytope.status, PolytopeStatus::kBounded);
  const DoubledEquations equations(polytope);
  const UnlimitedEdges unlimited(polytope);
  EXPECT_FALSE(unlimited.any());
  EXPECT_TRUE(unlimited.is_level(Forces{{0, 1.0}}));
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(equations.columns());
  EXPECT_EQ(unlimited.shift({one, one}), 0);
}

}  // namespace
}  // namespace indet
