#include "libindet/lp/vertex.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "libindet/base/error.h"
#include "libindet/base/tolerances.h"

namespace indet {
namespace {

/// Whether the sparse factor is the faster one, which takes some time for each of the r equations, and the
/// dense one d³ operations (docs/decisions/range-search.md).
bool is_for_sparse(const SlopeView& view) {
  constexpr int kFewestDimensions = 150;
  constexpr double kPerEquation = 1e4;
  const double d = view.dim();
  return view.set && d >= kFewestDimensions &&
         d * d * d >= kPerEquation * static_cast<double>(view.set->equations.rows());
}

}  // namespace

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

Eigen::VectorXd Vertex::edge_rates(const SlopeView& view, int k) const {
  if (sparse) return sparse->edge(k);
  return view.slope * edge_direction(k);
}

Eigen::VectorXd Vertex::direction(const SlopeView& view, const Eigen::VectorXd& rates) const {
  if (sparse) return sparse->direction(rates);
  return view.slope * active.solve(rates);
}

void Vertex::drop_factors() {
  active = {};
  sparse.reset();
}

Eigen::VectorXd Vertex::multipliers(const Objective& objective) const {
  if (basis.empty()) return {};
  if (sparse) return sparse->multipliers(objective.on_edges);
  const Eigen::VectorXd costs = active.transpose().solve(objective.along_z);
  return -costs;
}

Eigen::VectorXd Vertex::multipliers(const SlopeView& view, const Eigen::VectorXd& e) const {
  constexpr std::size_t kFew = 8;  // for which rows of S are faster than all of it
  std::vector<std::pair<int, double>> on_edges;
  for (Eigen::Index k = 0; k < e.size(); ++k) {
    if (e[k] != 0) on_edges.emplace_back(static_cast<int>(k), e[k]);
  }
  if (sparse) return sparse->multipliers(on_edges);
  if (on_edges.size() <= kFew) return multipliers(make_objective(view, std::move(on_edges)));
  return multipliers(Objective{view.slope.transpose() * e, {}});
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

Vertex locate_vertex(const SlopeView& view, const Basis& basis) {
  if (is_for_sparse(view) && std::ssize(basis) == view.dim()) {
    if (auto sparse = SparseBasis::factorise(view.set, basis)) {
      Vertex vertex;
      vertex.basis = basis;
      vertex.x = sparse->point();
      vertex.sparse = std::move(sparse);
      if (vertex.x.allFinite()) return vertex;
    }
  }
  return compute_vertex(view, basis);
}

double polytope_edge_length(const SlopeView& view, const Vertex& vertex, int k) {
  Eigen::VectorXd direction = vertex.edge_rates(view, k);
  for (const int active : vertex.basis) direction[active] = 0;
  double length = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < direction.size(); ++i) {
    if (direction[i] < -tolerance::kLengthRate)
      length = std::min(length, std::max(0.0, vertex.x[i]) / -direction[i]);
  }
  return length;
}

}  // namespace indet
