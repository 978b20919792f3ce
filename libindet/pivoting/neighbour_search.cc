#include "libindet/pivoting/neighbour_search.h"

#include <algorithm>
#include <cmath>

#include "libindet/base/constants.h"
#include "libindet/base/tolerances.h"
#include "libindet/dense/lu.h"

namespace indet {
namespace {

/// Walks at N = 95 take some tens of steps.
constexpr std::int64_t kStepLimit = 100000;

/// Where the d edges of the polytope at an extremal point lead.
struct Neighbours {
  Eigen::MatrixXd direction;  ///< d × d, one edge a column
  Eigen::VectorXd length;     ///< +inf where nothing ends the edge
  std::vector<int> stop;      ///< the inequality that ends it, or −1
};

Neighbours find_neighbours(const SlopeView& view, const Eigen::VectorXd& x,
                           const std::vector<char>& is_active,
                           const Eigen::PartialPivLU<Eigen::MatrixXd>& factors) {
  Neighbours result;
  result.direction = factors.inverse();
  const Eigen::MatrixXd rate = view.slope * result.direction;
  result.length = Eigen::VectorXd::Constant(view.dim(), kInfinity);
  result.stop.assign(static_cast<std::size_t>(view.dim()), -1);
  for (Eigen::Index j = 0; j < view.dim(); ++j) {
    for (Eigen::Index k = 0; k < rate.rows(); ++k) {
      const double approach = -rate(k, j);
      if (approach <= tolerance::kStepRate || is_active[static_cast<std::size_t>(k)] != 0) continue;
      const double slack = std::max(0.0, x[k]);
      if (slack >= result.length[j] * approach) continue;
      result.length[j] = slack / approach;
      result.stop[static_cast<std::size_t>(j)] = static_cast<int>(k);
    }
  }
  return result;
}

bool is_singular(const Eigen::PartialPivLU<Eigen::MatrixXd>& factors) {
  const auto pivots = factors.matrixLU().diagonal().cwiseAbs();
  return !(pivots.minCoeff() > tolerance::kLostDirections * pivots.maxCoeff());
}

}  // namespace

const char* to_string(WalkEnd end) {
  switch (end) {
    case WalkEnd::kNoneBetter:
      return "success";
    case WalkEnd::kMoreActive:
      return "more active constraints than dimensions";
    case WalkEnd::kFewerActive:
      return "fewer active constraints than dimensions";
    case WalkEnd::kDirectionsLost:
      return "edge directions lost";
    case WalkEnd::kPolytopeEdgeWithoutEnd:
      return "edge without end";
    case WalkEnd::kStepLimit:
      return "limit of steps";
  }
  return "?";
}

NeighbourSearch::NeighbourSearch(const SlopeView& view, double epsilon) : view_(view), epsilon_(epsilon) {}

NeighbourWalk NeighbourSearch::walk(const Objective& objective, const Basis& start) const {
  NeighbourWalk walk;
  walk.basis = start;
  const Vertex vertex = compute_vertex(view_, start);
  Eigen::VectorXd z = vertex.z;
  Eigen::VectorXd x = vertex.x;
  Eigen::PartialPivLU<Eigen::MatrixXd> factors = vertex.active;
  std::vector<char> is_active(static_cast<std::size_t>(view_.inequalities()), 0);
  for (const int k : start) is_active[static_cast<std::size_t>(k)] = 1;
  double value = objective.along_z.dot(z);
  const auto end_at = [&](WalkEnd end) {
    walk.end = end;
    std::sort(walk.basis.begin(), walk.basis.end());
    return walk;
  };
  for (;;) {
    if (walk.steps > 0) factors.compute(view_.slope(walk.basis, Eigen::all));
    if (is_singular(factors)) return end_at(WalkEnd::kDirectionsLost);
    const bool has_drifted = x(walk.basis).cwiseAbs().maxCoeff() > epsilon_;
    const bool has_more = (x.array() < epsilon_).count() > view_.dim();
    walk.unexpected += has_more ? 1 : 0;
    walk.neighbours += view_.dim();
    const Neighbours neighbours = find_neighbours(view_, x, is_active, factors);
    const Eigen::VectorXd slope = neighbours.direction.transpose() * objective.along_z;
    int best = -1;
    double best_gain = tolerance::kImprovingGain * std::max(1.0, std::abs(value));
    for (int j = 0; j < view_.dim(); ++j) {
      if (slope[j] <= tolerance::kImprovingSlope || slope[j] * neighbours.length[j] <= best_gain) continue;
      best = j;
      best_gain = slope[j] * neighbours.length[j];
    }
    if (best < 0) {
      if (has_drifted) return end_at(WalkEnd::kFewerActive);
      return end_at(has_more ? WalkEnd::kMoreActive : WalkEnd::kNoneBetter);
    }
    const int stop = neighbours.stop[static_cast<std::size_t>(best)];
    if (stop < 0) return end_at(WalkEnd::kPolytopeEdgeWithoutEnd);
    if (walk.steps == kStepLimit) return end_at(WalkEnd::kStepLimit);
    z += neighbours.length[best] * neighbours.direction.col(best);
    x = view_.offset + view_.slope * z;
    value = objective.along_z.dot(z);
    int& left = walk.basis[static_cast<std::size_t>(best)];
    is_active[static_cast<std::size_t>(left)] = 0;
    is_active[static_cast<std::size_t>(stop)] = 1;
    left = stop;
    ++walk.steps;
  }
}

}  // namespace indet
