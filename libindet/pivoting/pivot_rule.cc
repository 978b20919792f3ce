#include "libindet/pivoting/pivot_rule.h"

#include <algorithm>
#include <cmath>

#include "libindet/base/constants.h"
#include "libindet/base/tolerances.h"

namespace indet {
namespace {

/// How far each improving edge reaches; +inf where nothing stops it.
Eigen::VectorXd lengths(const Tableau& tableau, const std::vector<int>& columns) {
  Eigen::VectorXd length = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(columns.size()), kInfinity);
  for (Eigen::Index i = 0; i < tableau.rates().rows(); ++i) {
    const double slack = std::max(0.0, tableau.slacks()[i]);
    const double* const row = tableau.rates().row(i).data();
    for (std::size_t j = 0; j < columns.size(); ++j) {
      const double rate = -row[columns[j]];
      double& limit = length[static_cast<Eigen::Index>(j)];
      if (rate > tolerance::kStepRate && slack < limit * rate) limit = slack / rate;
    }
  }
  return length;
}

int best_neighbour(const Tableau& tableau, const Eigen::VectorXd& gradient, const std::vector<int>& columns) {
  const Eigen::VectorXd length = lengths(tableau, columns);
  int best = -1;
  double best_gain = -1;
  double best_slope = 0;
  for (std::size_t j = 0; j < columns.size(); ++j) {
    const double slope = gradient[columns[j]];
    const double gain = slope * length[static_cast<Eigen::Index>(j)];
    // At a degenerate vertex many neighbours are the vertex itself; the steepest then leads on.
    if (gain > best_gain || (gain == best_gain && slope > best_slope)) {
      best = columns[j];
      best_gain = gain;
      best_slope = slope;
    }
  }
  return best;
}

}  // namespace

const char* to_string(PivotRule rule) {
  switch (rule) {
    case PivotRule::kDantzig:
      return "Dantzig";
    case PivotRule::kSteepestEdge:
      return "steepest edge";
    case PivotRule::kBestNeighbour:
      return "best neighbour";
  }
  return "?";
}

int choose_column(const Tableau& tableau, const Eigen::VectorXd& gradient, const std::vector<char>& is_held,
                  PivotRule rule, double tolerance) {
  std::vector<int> improving;
  for (Eigen::Index j = 0; j < gradient.size(); ++j) {
    if (gradient[j] > tolerance && !is_held[static_cast<std::size_t>(j)])
      improving.push_back(static_cast<int>(j));
  }
  if (improving.empty()) return -1;
  if (rule == PivotRule::kBestNeighbour) return best_neighbour(tableau, gradient, improving);
  const auto merit = [&](int j) {
    const double squared = gradient[j] * gradient[j];
    return rule == PivotRule::kSteepestEdge ? squared / tableau.weights()[j] : squared;
  };
  return *std::max_element(improving.begin(), improving.end(),
                           [&](int a, int b) { return merit(a) < merit(b); });
}

int choose_column_by_number(const Tableau& tableau, const Eigen::VectorXd& gradient,
                            const std::vector<char>& is_held, double tolerance) {
  int chosen = -1;
  for (int j = 0; j < static_cast<int>(gradient.size()); ++j) {
    if (gradient[j] <= tolerance || is_held[static_cast<std::size_t>(j)]) continue;
    const auto number = [&](int column) { return tableau.active()[static_cast<std::size_t>(column)]; };
    if (chosen < 0 || number(j) < number(chosen)) chosen = j;
  }
  return chosen;
}

int first_stop(const Tableau& tableau, int column, double tolerance) {
  const Eigen::VectorXd rate = -tableau.rates().col(column);
  double reach = kInfinity;
  for (Eigen::Index i = 0; i < rate.size(); ++i) {
    if (rate[i] > tolerance::kStepRate)
      reach = std::min(reach, (std::max(0.0, tableau.slacks()[i]) + tolerance) / rate[i]);
  }
  int stop = -1;
  for (Eigen::Index i = 0; i < rate.size(); ++i) {
    if (rate[i] <= tolerance::kStepRate || tableau.slacks()[i] > reach * rate[i]) continue;
    if (stop < 0 || rate[i] > rate[stop]) stop = static_cast<int>(i);
  }
  return stop;
}

int first_stop_by_number(const Tableau& tableau, int column) {
  int stop = -1;
  double reach = kInfinity;
  for (Eigen::Index i = 0; i < tableau.rates().rows(); ++i) {
    const double rate = -tableau.rates()(i, column);
    if (rate <= tolerance::kStepRate) continue;
    const double distance = std::max(0.0, tableau.slacks()[i]) / rate;
    const bool equal = distance == reach;
    const bool smaller = stop >= 0 && tableau.slack()[static_cast<std::size_t>(i)] <
                                          tableau.slack()[static_cast<std::size_t>(stop)];
    if (distance < reach || (equal && smaller)) {
      stop = static_cast<int>(i);
      reach = distance;
    }
  }
  return stop;
}

}  // namespace indet
