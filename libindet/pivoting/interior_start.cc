#include "libindet/pivoting/interior_start.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "libindet/base/tolerances.h"
#include "libindet/dense/qr.h"

namespace indet {
namespace {

std::vector<int> active_at(const Eigen::VectorXd& x, double epsilon) {
  std::vector<int> active;
  for (int k = 0; k < static_cast<int>(x.size()); ++k) {
    if (x[k] < epsilon) active.push_back(k);
  }
  return active;
}

/// How far x + s · rate stays admissible; inequalities in `active` are preserved or left, and do not count.
double way_ahead(const Eigen::VectorXd& x, const Eigen::VectorXd& rate, const std::vector<int>& active) {
  double distance = std::numeric_limits<double>::infinity();
  for (int k = 0; k < static_cast<int>(x.size()); ++k) {
    if (rate[k] >= 0 || std::binary_search(active.begin(), active.end(), k)) continue;
    distance = std::min(distance, x[k] / -rate[k]);
  }
  return distance;
}

/// Leaves one of the active inequalities; false if none can be left.
bool leave_one(const SlopeView& view, const std::vector<int>& active, double epsilon, Eigen::VectorXd& z,
               Eigen::VectorXd& x) {
  const Eigen::MatrixXd rows = view.slope(active, Eigen::all);
  const MinimumNormSolver solver(rows);
  for (std::size_t i = 0; i < active.size(); ++i) {
    const Eigen::VectorXd wanted =
        Eigen::VectorXd::Unit(static_cast<Eigen::Index>(active.size()), static_cast<Eigen::Index>(i));
    const Eigen::VectorXd direction = solver.solve(wanted);
    if ((rows * direction - wanted).lpNorm<Eigen::Infinity>() > tolerance::kLeavingDirection) continue;
    const Eigen::VectorXd rate = view.slope * direction;
    const double step = std::min(1.0, way_ahead(x, rate, active) / 2);
    if (step < 2 * epsilon) continue;
    z += step * direction;
    x = view.offset + view.slope * z;
    return true;
  }
  return false;
}

}  // namespace

const char* to_string(InteriorEnd end) {
  switch (end) {
    case InteriorEnd::kFound:
      return "simulated state";
    case InteriorEnd::kUnknown:
      return "no simulated state";
    case InteriorEnd::kOutside:
      return "simulated state not admissible";
    case InteriorEnd::kTightCorner:
      return "simulated state in a tight corner";
  }
  return "?";
}

InteriorStart leave_sliding_contacts(const SlopeView& view, const Eigen::VectorXd& simulated,
                                     double epsilon) {
  InteriorStart start;
  if (!simulated.allFinite()) return start;
  Eigen::VectorXd z = solve_least_squares_pivoted(view.slope, simulated - view.offset);
  Eigen::VectorXd x = view.offset + view.slope * z;
  const double scale = std::max(1.0, simulated.lpNorm<Eigen::Infinity>());
  if ((x - simulated).lpNorm<Eigen::Infinity>() > tolerance::kSimulatedState * scale ||
      x.minCoeff() < -epsilon) {
    start.end = InteriorEnd::kOutside;
    return start;
  }
  std::vector<int> active = active_at(x, epsilon);
  start.sliding = static_cast<int>(active.size());
  while (!active.empty()) {
    if (!leave_one(view, active, epsilon, z, x)) {
      start.end = InteriorEnd::kTightCorner;
      return start;
    }
    const std::vector<int> remaining = active_at(x, epsilon);
    if (remaining.size() >= active.size()) {
      start.end = InteriorEnd::kTightCorner;
      return start;
    }
    start.left += static_cast<int>(active.size() - remaining.size());
    active = remaining;
  }
  start.end = InteriorEnd::kFound;
  start.z = std::move(z);
  return start;
}

}  // namespace indet
