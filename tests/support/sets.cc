#include "tests/support/sets.h"

#include <Eigen/LU>

namespace indet::test {

FeasibleSet random_polytope(int d, int extra, bool degenerate, Random& random) {
  FeasibleSet set;
  set.slope.resize(d + 1 + extra, d);
  set.offset.resize(d + 1 + extra);
  set.slope.topRows(d).setIdentity();
  set.slope.row(d).setConstant(-1);
  set.offset.head(d + 1).setConstant(1);
  for (int k = d + 1; k < set.inequalities(); ++k) {
    for (int j = 0; j < d; ++j)
      set.slope(k, j) = degenerate ? static_cast<double>(random.below(3)) - 1.0 : random.normal();
    set.offset[k] = degenerate ? 1 : random.uniform(0.3, 1);
  }
  describe_implicitly(set);
  return set;
}

void describe_implicitly(FeasibleSet& set) {
  const Eigen::FullPivLU<Eigen::MatrixXd> lu(set.slope.transpose());
  const Eigen::MatrixXd kernel = lu.kernel();
  set.equations = kernel.transpose().sparseView();
  set.right_hand_side = set.equations * set.offset;
}

}  // namespace indet::test
