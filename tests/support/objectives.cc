#include "tests/support/objectives.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "libindet/lp/vertex.h"

namespace indet::test {

Objective random_objective(const SlopeView& view, Random& random) {
  std::vector<std::pair<int, double>> on_edges;
  for (int k = 0; k < view.inequalities(); ++k)
    if (random.below(2) == 0) on_edges.emplace_back(k, random.normal());
  return make_objective(view, on_edges);
}

double best_corner(const SlopeView& view, const oracle::Corners& corners, const Objective& objective,
                   const std::vector<int>& held) {
  double best = -1e300;
  for (const auto& corner : corners.vertices.rowwise()) {
    const Eigen::VectorXd z = corner.transpose();
    const bool on_face = std::all_of(held.begin(), held.end(), [&](int k) {
      return std::abs(view.offset[k] + view.slope.row(k).dot(z)) < 1e-9;
    });
    if (on_face) best = std::max(best, objective.along_z.dot(z));
  }
  return best;
}

double value_of(const SlopeView& view, const Objective& objective, const LpAnswer& answer) {
  const Vertex vertex = compute_vertex(view, answer.basis);
  EXPECT_LE(vertex.infeasibility(), 1e-9);
  return objective.along_z.dot(vertex.z);
}

}  // namespace indet::test
