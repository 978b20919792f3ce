#include "libindet/pivoting/neighbour_search.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "libindet/base/constants.h"
#include "libindet/base/random.h"
#include "libindet/base/tolerances.h"
#include "libindet/dense/lu.h"

namespace indet {
namespace {

/// Walks at N = 95 take some tens of steps.
constexpr std::int64_t kStepLimit = 100000;

using Factors = Eigen::PartialPivLU<Eigen::MatrixXd>;

/// The inverse of the active rows S_N: column k is the direction of the edge on which the inequality at place
/// k is relaxed. Follows a change of one row by a change of rank one (d²), and is computed anew (d³) before
/// rounding adds up.
class EdgeDirections {
 public:
  explicit EdgeDirections(const Factors& factors) { take(factors); }

  bool are_lost() const { return lost_; }
  auto direction(int place) const { return inverse_.col(place); }
  /// Of the objective along each edge.
  Eigen::VectorXd slopes(const Objective& objective) const {
    return inverse_.transpose() * objective.along_z;
  }

  void take(const Factors& factors) {
    changes_ = 0;
    const auto pivots = factors.matrixLU().diagonal().cwiseAbs();
    lost_ = !(pivots.minCoeff() > tolerance::kLostDirections * pivots.maxCoeff());
    if (!lost_) inverse_ = factors.inverse();
  }

  /// After the row at `place` of the basis has become that of another inequality: (I + e_r (v − e_r)ᵀ) S is
  /// the new S_N, with v = S⁻ᵀ times the new row. Returns false if it was computed anew.
  bool replace(const SlopeView& view, const Basis& basis, int place) {
    constexpr int kChanges = 32;
    const int row = basis[static_cast<std::size_t>(place)];
    Eigen::VectorXd v = inverse_.transpose() * view.slope.row(row).transpose();
    const double pivot = v[place];
    if (++changes_ > kChanges || !(std::abs(pivot) > tolerance::kDirectionPivot * v.cwiseAbs().maxCoeff())) {
      take(Factors(view.slope(basis, Eigen::all)));
      return false;
    }
    v[place] -= 1;
    const Eigen::VectorXd column = inverse_.col(place) / pivot;
    inverse_.noalias() -= column * v.transpose();
    return true;
  }

 private:
  Eigen::MatrixXd inverse_;
  int changes_ = 0;
  bool lost_ = false;
};

/// The extremal point where a walk stands.
struct ExtremalPoint {
  Eigen::VectorXd x;
  std::vector<char> is_active;  ///< by inequality: 1 for those of the basis
  EdgeDirections directions;

  bool has_more_active_than(Eigen::Index count, double epsilon) const {
    return (x.array() < epsilon).count() > count;
  }
};

/// A neighbour of an extremal point.
struct Neighbour {
  int relaxed = -1;           ///< place in the basis of the inequality that was relaxed; −1: there is none
  int stop = -1;              ///< the inequality that ends the edge, or −1
  double gain = 0;            ///< of the objective, up to the neighbour
  double length = kInfinity;  ///< of the edge, in units of its direction
  Eigen::VectorXd rate;       ///< of the slacks along the direction
};

/// Along the edge of the polytope on which the inequality at place `relaxed` of the basis is relaxed.
/// `slope`: of the objective along it.
Neighbour follow_edge(const SlopeView& view, const ExtremalPoint& point, int relaxed, double slope) {
  Neighbour neighbour;
  neighbour.relaxed = relaxed;
  neighbour.rate = view.slope * point.directions.direction(relaxed);
  double& length = neighbour.length;
  for (Eigen::Index k = 0; k < neighbour.rate.size(); ++k) {
    const double approach = -neighbour.rate[k];
    if (approach <= tolerance::kStepRate || point.is_active[static_cast<std::size_t>(k)] != 0) continue;
    const double slack = std::max(0.0, point.x[k]);
    if (slack >= length * approach) continue;
    length = slack / approach;
    neighbour.stop = static_cast<int>(k);
  }
  neighbour.gain = slope * length;
  return neighbour;
}

/// The neighbour to go to: the first that gains more than `least_gain` or, if `best`, the best of these.
/// `order`: places in the basis, as their inequalities are relaxed in turn. Counts the neighbours looked at.
Neighbour choose_neighbour(const SlopeView& view, const ExtremalPoint& point, const Objective& objective,
                           const std::vector<int>& order, bool best, double least_gain,
                           std::int64_t& looked_at) {
  const Eigen::VectorXd slope = point.directions.slopes(objective);
  Neighbour chosen;
  chosen.gain = least_gain;
  for (const int relaxed : order) {
    ++looked_at;
    if (slope[relaxed] <= tolerance::kImprovingSlope) continue;
    Neighbour neighbour = follow_edge(view, point, relaxed, slope[relaxed]);
    if (neighbour.gain <= chosen.gain) continue;
    chosen = std::move(neighbour);
    if (!best) break;
  }
  return chosen;
}

/// Puts numbers into an order drawn at random.
void shuffle(std::vector<int>& numbers, Random& random) {
  for (std::size_t i = numbers.size(); i > 1; --i) std::swap(numbers[i - 1], numbers[random.below(i)]);
}

}  // namespace

const char* to_string(NeighbourRule rule) {
  switch (rule) {
    case NeighbourRule::kFirst:
      return "first";
    case NeighbourRule::kBest:
      return "best";
    case NeighbourRule::kRandom:
      return "random";
  }
  return "?";
}

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

NeighbourSearch::NeighbourSearch(const SlopeView& view, double epsilon, NeighbourRule rule,
                                 std::uint64_t seed)
    : view_(view), epsilon_(epsilon), rule_(rule), seed_(seed) {}

NeighbourWalk NeighbourSearch::walk(const Objective& objective, const Basis& start,
                                    std::uint64_t number) const {
  NeighbourWalk walk;
  walk.basis = start;
  const Vertex vertex = compute_vertex(view_, start);
  Eigen::VectorXd z = vertex.z;
  ExtremalPoint point{vertex.x, std::vector<char>(static_cast<std::size_t>(view_.inequalities()), 0),
                      EdgeDirections(vertex.active)};
  for (const int k : start) point.is_active[static_cast<std::size_t>(k)] = 1;
  double value = objective.along_z.dot(z);
  std::vector<int> order(static_cast<std::size_t>(view_.dim()));
  std::iota(order.begin(), order.end(), 0);
  Random random(seed_, number);
  const auto end_at = [&](WalkEnd end) {
    walk.end = end;
    std::sort(walk.basis.begin(), walk.basis.end());
    return walk;
  };
  for (;;) {
    if (point.directions.are_lost()) return end_at(WalkEnd::kDirectionsLost);
    walk.unexpected += point.has_more_active_than(view_.dim(), epsilon_) ? 1 : 0;
    if (rule_ == NeighbourRule::kRandom) shuffle(order, random);
    const Neighbour next =
        choose_neighbour(view_, point, objective, order, rule_ == NeighbourRule::kBest,
                         tolerance::kImprovingGain * std::max(1.0, std::abs(value)), walk.neighbours);
    if (next.relaxed < 0) {
      point.x = view_.offset + view_.slope * z;
      if (point.x(walk.basis).cwiseAbs().maxCoeff() > epsilon_) return end_at(WalkEnd::kFewerActive);
      return end_at(point.has_more_active_than(view_.dim(), epsilon_) ? WalkEnd::kMoreActive
                                                                      : WalkEnd::kNoneBetter);
    }
    if (next.stop < 0) return end_at(WalkEnd::kPolytopeEdgeWithoutEnd);
    if (walk.steps == kStepLimit) return end_at(WalkEnd::kStepLimit);
    z += next.length * point.directions.direction(next.relaxed);
    value = objective.along_z.dot(z);
    int& relaxed = walk.basis[static_cast<std::size_t>(next.relaxed)];
    point.is_active[static_cast<std::size_t>(relaxed)] = 0;
    point.is_active[static_cast<std::size_t>(next.stop)] = 1;
    relaxed = next.stop;
    ++walk.steps;
    if (point.directions.replace(view_, walk.basis, next.relaxed)) {
      point.x += next.length * next.rate;
    } else {
      point.x = view_.offset + view_.slope * z;
    }
  }
}

}  // namespace indet
