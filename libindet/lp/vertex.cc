#include "libindet/lp/vertex.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "libindet/base/error.h"
#include "libindet/base/tolerances.h"

namespace indet {

Objective make_objective(const SlopeView& view, std::vector<std::pair<int, double>> on_edges) {
  Objective objective;
  objective.along_z = Eigen::VectorXd::Zero(view.dim());
  for (const auto& [index, coefficient] : on_edges)
    objective.along_z += coefficient * view.slope.row(index).transpose();
  objective.on_edges = std::move(on_edges);
  return objective;
}

double Vertex::infeasibility() const { return x.size() == 0 ? 0 : std::max(0.0, -x.minCoeff()); }

Eigen::VectorXd Vertex::edge_direction(int k) const {
  return active.solve(Eigen::VectorXd::Unit(z.size(), k));
}

Eigen::VectorXd Vertex::multipliers(const Eigen::Ref<const Eigen::VectorXd>& g) const {
  if (z.size() == 0) return {};
  const Eigen::VectorXd costs = active.transpose().solve(g);
  return -costs;
}

Vertex compute_vertex(const SlopeView& view, const Basis& basis) {
  Vertex vertex;
  vertex.basis = basis;
  const int d = view.dim();
  if (static_cast<int>(basis.size()) != d)
    throw LibraryError("a vertex needs as many active inequalities as dimensions");
  if (d > 0) {
    const Eigen::MatrixXd rows = view.slope(basis, Eigen::all);
    const Eigen::VectorXd offset = view.offset(basis);
    vertex.active.compute(rows);
    vertex.z = vertex.active.solve(-offset);
    vertex.z += vertex.active.solve(-offset - rows * vertex.z);
    if (!vertex.z.allFinite()) throw LibraryError("the active inequalities of a vertex are not independent");
  } else {
    vertex.z.resize(0);
  }
  vertex.x = view.offset + view.slope * vertex.z;
  for (const int k : basis) vertex.x[k] = 0;
  return vertex;
}

double polytope_edge_length(const SlopeView& view, const Vertex& vertex, int k) {
  Eigen::VectorXd direction = view.slope * vertex.edge_direction(k);
  for (const int active : vertex.basis) direction[active] = 0;
  double length = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < direction.size(); ++i) {
    if (direction[i] < -tolerance::kLengthRate)
      length = std::min(length, std::max(0.0, vertex.x[i]) / -direction[i]);
  }
  return length;
}

}  // namespace indet
