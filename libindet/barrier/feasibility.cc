#include "libindet/barrier/feasibility.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "libindet/barrier/self_dual.h"
#include "libindet/barrier/vectors.h"
#include "libindet/base/constants.h"
#include "libindet/base/tolerances.h"

namespace indet::barrier {
namespace {

constexpr int kMends = 4;

/// Moves x by D Aᵀ w, D = diag(x²), so that A x = b. Returns the largest relative change of an entry in the
/// last step: below 1, an exact solution with the same signs is near.
double mend_state(const BlockStructure& structure, BlockCholesky& cholesky, std::span<const double> b,
                  std::vector<double>& x) {
  std::vector<double> D(x.size());
  for (std::size_t k = 0; k < x.size(); ++k) D[k] = x[k] * x[k];
  cholesky.factor(D);
  double change = 0;
  for (int step = 0; step < kMends; ++step) {
    std::vector<double> w = product(structure, x);
    for (std::size_t i = 0; i < w.size(); ++i) w[i] = b[i] - w[i];
    cholesky.solve(w);
    const std::vector<double> along = transposed_product(structure, w);
    change = 0;
    for (std::size_t k = 0; k < x.size(); ++k) {
      if (D[k] == 0) continue;
      change = std::max(change, std::abs(D[k] * along[k]) / std::abs(x[k]));
      x[k] += D[k] * along[k];
      if (!(x[k] > 0)) return kInfinity;
    }
  }
  return change;
}

/// Moves y so that (Aᵀ y)_k = 0 on the edges that rest, by weighted least squares with the weights D of the
/// last iteration. Returns Aᵀ y.
std::vector<double> mend_motion(const BlockStructure& structure, BlockCholesky& cholesky,
                                std::span<const double> D, const std::vector<bool>& rests,
                                std::vector<double>& y) {
  cholesky.factor(D);
  for (int step = 0; step < kMends; ++step) {
    std::vector<double> power = transposed_product(structure, y);
    for (std::size_t k = 0; k < power.size(); ++k) power[k] = rests[k] ? D[k] * power[k] : 0;
    std::vector<double> w = product(structure, power);
    cholesky.solve(w);
    for (std::size_t i = 0; i < y.size(); ++i) y[i] -= w[i];
  }
  return transposed_product(structure, y);
}

/// Weights of the last iteration, cut off where the normal equations would lose the small ones.
std::vector<double> limited_weights(const SelfDualPoint& point) {
  std::vector<double> D(point.x.size());
  for (std::size_t k = 0; k < D.size(); ++k)
    D[k] = std::clamp(point.x[k] / point.s[k], tolerance::kLeastWeight, 1 / tolerance::kLeastWeight);
  return D;
}

}  // namespace

Feasibility find_feasibility(const BlockStructure& structure, BlockCholesky& cholesky) {
  Feasibility result;
  const std::vector<double>& b = structure.load();
  const auto n = static_cast<std::size_t>(structure.columns());
  // Strengths are several times as large as the loads.
  const double largest_load = std::max(1.0, largest_entry(b));
  const double unit = 10 * largest_load;
  std::vector<double> scaled_b = b;
  multiply_by(scaled_b, 1 / unit);
  const std::vector<double> zero(n, 0.0);
  const SelfDualPoint point = solve_self_dual(structure, cholesky, scaled_b, zero);
  result.margin = point.margin;
  result.iterations = point.iterations;
  std::vector<bool> rests(n);
  for (std::size_t k = 0; k < n; ++k) {
    rests[k] = point.x[k] > point.s[k];
    if (!rests[k]) result.closed.push_back(static_cast<int>(k));
  }
  const bool is_empty = point.kappa > point.tau;
  if (!is_empty) {
    result.x = point.x;
    multiply_by(result.x, unit / point.tau);
    for (std::size_t k = 0; k < n; ++k) result.x[k] = rests[k] ? result.x[k] : 0;
    const bool is_state = mend_state(structure, cholesky, b, result.x) <= tolerance::kMendedState;
    if (is_state && result.closed.empty()) {
      result.kind = Feasibility::Kind::kInterior;
      return result;
    }
    if (!is_state) result.x.clear();
  }
  // A motion that closes edges, or shows that there is no state.
  result.y = point.y;
  multiply_by(result.y, -1 / largest_entry(point.y));
  std::vector<double> power = mend_motion(structure, cholesky, limited_weights(point), rests, result.y);
  const double size = largest_entry(result.y);
  multiply_by(result.y, 1 / size);
  const double work = dot(b, result.y);
  double possible_work = 0;
  for (std::size_t i = 0; i < b.size(); ++i) possible_work += std::abs(b[i] * result.y[i]);
  double resisted = 0, opening = kInfinity;
  for (std::size_t k = 0; k < n; ++k) {
    power[k] /= size;
    if (rests[k]) {
      resisted = std::max(resisted, std::abs(power[k]));
    } else {
      opening = std::min(opening, power[k]);
    }
  }
  const bool is_clear = point.margin >= tolerance::kLeastSplit && std::isfinite(size) &&
                        resisted <= tolerance::kRestingPower && opening >= tolerance::kOpeningPower;
  if (is_empty && is_clear && work <= -tolerance::kOpeningPower * possible_work &&
      work < -tolerance::kRestingPower * largest_load) {
    result.kind = Feasibility::Kind::kEmpty;
    result.closed.clear();
  } else if (!is_empty && is_clear && !result.x.empty() &&
             std::abs(work) <= tolerance::kRestingPower * largest_load) {
    result.kind = Feasibility::Kind::kClosed;
  } else {
    result.x.clear();
    result.y.clear();
    result.closed.clear();
  }
  return result;
}

Boundedness find_boundedness(const BlockStructure& structure, BlockCholesky& cholesky) {
  Boundedness result;
  const auto n = static_cast<std::size_t>(structure.columns());
  const std::vector<double> no_load(static_cast<std::size_t>(structure.rows()), 0.0);
  const std::vector<double> costs(n, -1.0);
  const SelfDualPoint point = solve_self_dual(structure, cholesky, no_load, costs);
  result.margin = point.margin;
  result.iterations = point.iterations;
  if (point.tau > point.kappa) {
    // Aᵀ y ≥ 1 needs no trust in how y was found.
    result.y = point.y;
    multiply_by(result.y, -1 / point.tau);
    const std::vector<double> power = transposed_product(structure, result.y);
    const double least = n > 0 ? *std::min_element(power.begin(), power.end()) : 1;
    const double noise = tolerance::kNoise * std::max(1.0, largest_entry(result.y));
    result.bounded = result.decided = least > 0.5 && noise < 0.25 && std::isfinite(noise);
    if (result.bounded) multiply_by(result.y, 1 / std::min(1.0, least - noise));
    if (!result.decided) result.y.clear();
    return result;
  }
  result.ray = point.x;
  for (std::size_t k = 0; k < n; ++k) {
    if (point.x[k] < point.s[k]) result.ray[k] = 0;
  }
  const double change = mend_state(structure, cholesky, no_load, result.ray);
  const double sum = std::accumulate(result.ray.begin(), result.ray.end(), 0.0);
  result.decided = change <= tolerance::kMendedState && point.margin >= tolerance::kLeastSplit && sum > 0;
  if (result.decided) {
    multiply_by(result.ray, 1 / sum);
  } else {
    result.ray.clear();
  }
  return result;
}

}  // namespace indet::barrier
