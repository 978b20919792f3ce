#include "libindet/barrier/lexicographic_vertex.h"

#include <algorithm>

#include "libindet/base/constants.h"
#include "libindet/base/tolerances.h"

namespace indet::barrier {
namespace {

/// The column of most negative cost of `free`; −1 if there is none.
int find_entering(const std::vector<int>& free, const std::vector<double>& costs, double tie) {
  const auto cost = [&](int column) { return costs[static_cast<std::size_t>(column)]; };
  const auto least =
      std::min_element(free.begin(), free.end(), [&](int a, int b) { return cost(a) < cost(b); });
  return least != free.end() && cost(*least) < -tie ? *least : -1;
}

/// The basic column that reaches 0 first; −1 if none does.
int find_leaving(const BasisVertex& basis, const std::vector<double>& x,
                 const std::vector<double>& direction) {
  int leaving = -1;
  double least = kInfinity;
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (direction[k] >= -tolerance::kVertexPivot || !basis.is_basic(static_cast<int>(k))) continue;
    const double step = x[k] / -direction[k];
    if (step >= least) continue;
    least = step;
    leaving = static_cast<int>(k);
  }
  return leaving;
}

/// The basic column of most negative x, −1 if none is below what rounding leaves.
int find_infeasible(const std::vector<double>& x) {
  const auto least = std::min_element(x.begin(), x.end());
  const double largest = std::max(1.0, *std::max_element(x.begin(), x.end()));
  return *least < -tolerance::kPrimalResidual * largest ? static_cast<int>(least - x.begin()) : -1;
}

/// The closed column that can take the place of a basic one whose x is negative, without the reduced costs
/// becoming negative (Lemke 1954); −1 if there is none.
int find_replacement(const BasisVertex& basis, std::span<const std::vector<double>> functionals, int leaving,
                     double tie) {
  std::vector<double> rates(functionals.front().size(), 0);  // of that x with each closed one
  rates[static_cast<std::size_t>(leaving)] = 1;
  basis.price(rates);
  std::vector<int> still = basis.closed();
  std::erase_if(
      still, [&](int column) { return rates[static_cast<std::size_t>(column)] <= tolerance::kVertexPivot; });
  for (const std::vector<double>& functional : functionals) {
    if (still.size() < 2) break;
    std::vector<double> costs = functional;
    basis.price(costs);
    const auto ratio = [&](int column) {
      const auto k = static_cast<std::size_t>(column);
      return costs[k] / rates[k];
    };
    const int least =
        *std::min_element(still.begin(), still.end(), [&](int a, int b) { return ratio(a) < ratio(b); });
    const double limit = ratio(least) + tie;
    std::erase_if(still, [&](int column) { return ratio(column) > limit; });
  }
  return still.empty() ? -1 : still.front();
}

class Descent {
 public:
  Descent(BasisVertex& basis, std::span<const std::vector<double>> functionals,
          std::span<const double> generic_load, double tie, int& steps)
      : basis_(basis), functionals_(functionals), generic_load_(generic_load), tie_(tie), steps_(steps) {}

  /// Makes one functional after the other least. What would make an earlier one larger stays closed, so that
  /// no step is taken back.
  bool run() {
    std::vector<bool> is_held(functionals_.front().size(), false);
    for (const std::vector<double>& functional : functionals_) {
      std::vector<double> costs;
      while (true) {
        costs = functional;
        basis_.price(costs);
        std::vector<int> free = basis_.closed();
        std::erase_if(free, [&](int column) { return is_held[static_cast<std::size_t>(column)]; });
        if (free.empty()) return mend();
        const int entering = find_entering(free, costs, tie_);
        if (entering < 0) break;
        if (!exchange(entering,
                      find_leaving(basis_, basis_.solution(generic_load_), basis_.direction(entering))))
          return false;
      }
      for (const int column : basis_.closed()) {
        if (costs[static_cast<std::size_t>(column)] > tie_) is_held[static_cast<std::size_t>(column)] = true;
      }
    }
    return mend();
  }

 private:
  bool exchange(int entering, int leaving) {
    if (entering < 0 || leaving < 0 || taken_ == tolerance::kMostVertexSteps) return false;
    ++taken_;
    ++steps_;
    return basis_.exchange(entering, leaving);
  }

  /// What is infeasible with b itself.
  bool mend() {
    for (int leaving = find_infeasible(basis_.x()); leaving >= 0; leaving = find_infeasible(basis_.x())) {
      if (!exchange(find_replacement(basis_, functionals_, leaving, tie_), leaving)) return false;
    }
    return true;
  }

  BasisVertex& basis_;
  std::span<const std::vector<double>> functionals_;
  std::span<const double> generic_load_;
  double tie_;
  int& steps_;
  int taken_ = 0;
};

}  // namespace

std::optional<LexicographicVertex> find_lexicographic_vertex(BasisVertex& basis,
                                                             std::span<const std::vector<double>> functionals,
                                                             std::span<const double> generic_load,
                                                             int& steps) {
  // Steps on an optimal face can add up what was taken for 0.
  for (const double share : {1.0, 0.1, 0.01}) {
    if (!Descent(basis, functionals, generic_load, share * tolerance::kReducedCost, steps).run()) return {};
    std::vector<double> costs = functionals.front();
    LexicographicVertex vertex{basis.x(), basis.price(costs), basis.closed()};
    double least = kInfinity;
    for (const int column : vertex.closed) least = std::min(least, costs[static_cast<std::size_t>(column)]);
    if (least < -tolerance::kReducedCost) continue;
    for (double& strength : vertex.x) strength = std::max(strength, 0.0);
    vertex.dual_residual = std::max(0.0, -least);
    vertex.is_unique = least > tolerance::kReducedCost;
    return vertex;
  }
  return {};
}

}  // namespace indet::barrier
