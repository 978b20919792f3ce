#include "tests/support/sets.h"

#include <Eigen/LU>
#include <memory>
#include <utility>

namespace indet::test {

SlopeView random_polytope(int d, int extra, bool degenerate, Random& random) {
  SlopeView view;
  view.slope.resize(d + 1 + extra, d);
  view.offset.resize(d + 1 + extra);
  view.slope.topRows(d).setIdentity();
  view.slope.row(d).setConstant(-1);
  view.offset.head(d + 1).setConstant(1);
  for (int k = d + 1; k < view.inequalities(); ++k) {
    for (int j = 0; j < d; ++j)
      view.slope(k, j) = degenerate ? static_cast<double>(random.below(3)) - 1.0 : random.normal();
    view.offset[k] = degenerate ? 1 : random.uniform(0.3, 1);
  }
  make_set(view);
  return view;
}

void make_set(SlopeView& view) {
  const Eigen::FullPivLU<Eigen::MatrixXd> lu(view.slope.transpose());
  const Eigen::MatrixXd kernel = lu.kernel();
  FeasibleSet set{kernel.transpose().sparseView(), {}};
  set.right_hand_side = set.equations * view.offset;
  view.set = std::make_shared<FeasibleSet>(std::move(set));
}

}  // namespace indet::test
