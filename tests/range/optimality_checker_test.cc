#include "libindet/range/optimality_checker.h"

#include <gtest/gtest.h>

#include <vector>

namespace indet {
namespace {

/// A pyramid over a square, |z_0| ≤ z_2, |z_1| ≤ z_2 ≤ 1: four inequalities meet in its apex.
SlopeView pyramid() {
  SlopeView view;
  view.slope.resize(5, 3);
  view.slope << -1, 0, 1,  //
      1, 0, 1,             //
      0, -1, 1,            //
      0, 1, 1,             //
      0, 0, -1;
  view.offset = Eigen::VectorXd::Unit(5, 4);
  return view;
}

TEST(OptimalityChecker, EdgesOfAFaceAtADegenerateVertex) {
  const SlopeView view = pyramid();
  const std::vector<Component> components = {{{{4, 1.0}}}};
  const Eigen::VectorXd weight = Eigen::VectorXd::Ones(5);
  const OptimalityChecker checker(view, components, weight, true);
  struct Case {
    Basis basis;
    std::vector<int> held;
    bool has_edge;
  };
  // Opposite faces of the pyramid meet in the apex alone, neighbours in an edge.
  for (const Case& c :
       {Case{{0, 1, 2}, {0, 1}, false}, Case{{0, 2, 3}, {0, 1}, false}, Case{{1, 2, 3}, {0, 1}, false},
        Case{{0, 1, 2}, {0, 2}, true}, Case{{0, 1, 2}, {1, 2}, true}, Case{{0, 2, 3}, {0}, true}}) {
    CheckedVertex checked = checker.recompute(c.basis);
    EXPECT_NEAR(checked.vertex.z.norm(), 0, 1e-15);
    EXPECT_EQ(checker.has_free_polytope_edge(checked, c.held), c.has_edge)
        << c.basis[0] << c.basis[1] << c.basis[2] << ", " << c.held.size();
  }
}

}  // namespace
}  // namespace indet
