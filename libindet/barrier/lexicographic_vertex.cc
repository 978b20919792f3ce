#include "libindet/barrier/lexicographic_vertex.h"

#include <algorithm>
#include <utility>

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

/// The closed column that can take the place of a basic one whose x is negative, without the reduced costs
/// becoming negative (Lemke 1954); −1 if there is none.
int find_replacement(const BasisVertex& basis, std::span<const std::vector<double>> functionals, int leaving,
                     double tie) {
  const std::vector<double> rates = basis.row(leaving);
  std::vector<int> still = basis.closed();
  std::erase_if(
      still, [&](int column) { return rates[static_cast<std::size_t>(column)] <= tolerance::kVertexPivot; });
  for (const std::vector<double>& functional : functionals) {
    if (still.size() < 2) break;
    std::vector<double> costs = functional;
    basis.price(costs);
    const auto ratio = [&](int column, double room) {
      const auto k = static_cast<std::size_t>(column);
      return (costs[k] + room) / rates[k];
    };
    double limit = kInfinity;
    for (const int column : still) limit = std::min(limit, ratio(column, tie));
    std::erase_if(still, [&](int column) { return ratio(column, 0) > limit; });
  }
  return still.empty() ? -1 : still.front();
}

class Descent {
 public:
  Descent(BasisVertex& basis, std::span<const std::vector<double>> functionals, std::span<const double> load,
          std::span<const double> generic_load, double tie, const VertexSearch& search)
      : basis_(basis),
        functionals_(functionals),
        load_(load),
        generic_load_(generic_load),
        tie_(tie),
        search_(search) {}

  /// Makes one functional after the other least. What would make an earlier one larger stays closed, so that
  /// no step is taken back.
  bool run() {
    std::vector<bool> is_held(functionals_.front().size(), false);
    if (!find_generic_x()) return false;
    for (const std::vector<double>& functional : functionals_) {
      find_costs(functional);
      while (true) {
        std::vector<int> free = basis_.closed();
        std::erase_if(free, [&](int column) { return is_held[static_cast<std::size_t>(column)]; });
        if (free.empty()) return mend();
        const int entering = find_entering(free, costs_, tie_);
        if (entering < 0) {
          if (!are_updated_) break;
          find_costs(functional);
        } else if (!descend(entering, functional)) {
          return false;
        }
      }
      for (const int column : basis_.closed()) {
        if (costs_[static_cast<std::size_t>(column)] > tie_) is_held[static_cast<std::size_t>(column)] = true;
      }
    }
    return mend();
  }

 private:
  void find_costs(const std::vector<double>& functional) {
    costs_ = functional;
    basis_.price(costs_);
    are_updated_ = false;
  }

  bool find_generic_x() {
    std::optional<std::vector<double>> x = basis_.solution(generic_load_);
    if (x) generic_x_ = std::move(*x);
    return x.has_value();
  }

  /// One step of the primal simplex method. Costs and x are updated, and found anew with each new factor.
  bool descend(int entering, const std::vector<double>& functional) {
    const std::vector<double> direction = basis_.direction(entering);
    const int leaving = find_leaving(basis_, generic_x_, direction);
    if (leaving < 0) return false;
    const auto in = static_cast<std::size_t>(entering), out = static_cast<std::size_t>(leaving);
    const std::vector<double> rates = basis_.row(leaving);
    if (!exchange(entering, leaving, direction)) return false;
    if (basis_.is_fresh()) {
      find_costs(functional);
      return find_generic_x();
    }
    const double step = generic_x_[out] / -direction[out];
    for (std::size_t k = 0; k < generic_x_.size(); ++k) generic_x_[k] += step * direction[k];
    generic_x_[out] = 0;
    const double slope = costs_[in] / -rates[in];
    for (const int column : basis_.closed()) {
      const auto k = static_cast<std::size_t>(column);
      costs_[k] += slope * rates[k];
    }
    costs_[out] = -slope;
    costs_[in] = 0;
    are_updated_ = true;
    return true;
  }

  bool exchange(int entering, int leaving, const std::vector<double>& direction) {
    if (taken_ == tolerance::kMostVertexSteps || !search_.keep_on()) return false;
    ++taken_;
    ++search_.steps;
    return basis_.exchange(entering, leaving, direction);
  }

  /// From the generic b to b itself, b + t (generic b − b) with t from 1 to 0: where the x of a basic column
  /// becomes negative another one takes its place, by the dual simplex method. The vertex for each t is the
  /// best one, and t falls, so that no basis comes twice (Gass and Saaty 1955).
  bool mend() {
    while (true) {
      const std::optional<std::vector<double>> x = basis_.solution(load_);
      if (!x) return false;
      const double largest = std::max(1.0, *std::max_element(x->begin(), x->end()));
      if (*std::min_element(x->begin(), x->end()) >= -tolerance::kPrimalResidual * largest) return true;
      if (!find_generic_x()) return false;
      const int leaving = find_first_negative(*x, tolerance::kPrimalResidual * largest);
      const int entering = find_replacement(basis_, functionals_, leaving, tie_);
      if (entering < 0 || !exchange(entering, leaving, basis_.direction(entering))) return false;
    }
  }

  /// The column that is negative at the largest t of those that are at t = 0.
  int find_first_negative(const std::vector<double>& x, double zero) const {
    int first = -1;
    double largest = -kInfinity;
    for (std::size_t k = 0; k < x.size(); ++k) {
      if (x[k] >= -zero) continue;
      const double t = generic_x_[k] > x[k] ? x[k] / (x[k] - generic_x_[k]) : kInfinity;
      if (t <= largest) continue;
      largest = t;
      first = static_cast<int>(k);
    }
    return first;
  }

  BasisVertex& basis_;
  std::span<const std::vector<double>> functionals_;
  std::span<const double> load_, generic_load_;
  double tie_;
  const VertexSearch& search_;
  std::vector<double> generic_x_, costs_;
  bool are_updated_ = false;  ///< costs, since they were found anew
  int taken_ = 0;
};

}  // namespace

std::optional<LexicographicVertex> find_lexicographic_vertex(BasisVertex& basis,
                                                             std::span<const std::vector<double>> functionals,
                                                             std::span<const double> load,
                                                             std::span<const double> generic_load,
                                                             const VertexSearch& search) {
  // Steps on an optimal face can add up what was taken for 0.
  for (const double share : {1.0, 0.01, 0.001}) {
    if (!Descent(basis, functionals, load, generic_load, share * tolerance::kReducedCost, search).run())
      return {};
    const std::optional<std::vector<double>> x = basis.solution(load);
    if (!x) return {};
    std::vector<double> costs = functionals.front();
    LexicographicVertex vertex{*x, basis.price(costs), basis.closed()};
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
