#include "libindet/barrier/independent_parts.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "libindet/barrier/block_cholesky.h"
#include "libindet/barrier/vectors.h"
#include "libindet/base/disjoint_sets.h"
#include "libindet/base/random.h"
#include "libindet/base/tolerances.h"

namespace indet::barrier {
namespace {

constexpr int kSamples = 4;      ///< random vectors that tell how far groups move
constexpr int kProjections = 3;  ///< of one vector: each leaves rounding of what the one before left
constexpr int kMostSteps = 100;  ///< about as much work as finding the centre

enum class State : std::uint8_t { kFree, kGrowing, kDone };

class PartSearch {
 public:
  PartSearch(const BlockStructure& structure, std::span<const double> x)
      : structure_(structure), x_(x), cholesky_(structure), state_(structure.groups().size(), State::kFree) {
    std::vector<double> squares;
    for (const double value : x) squares.push_back(value * value);
    cholesky_.factor(squares);
  }

  IndependentParts run() {
    if (!find_moving()) return {-1, "rounding hides which forces can vary"};
    int parts = 0;
    for (int step = 0; step < kMostSteps; ++step) {
      join_regions();
      if (!start_in_each_region()) return {parts, ""};
      const int ended = grow();
      if (ended < 0) return {-1, "rounding hides which forces depend on each other"};
      parts += ended;
    }
    return {-1, "there are more of them than are looked for"};
  }

 private:
  /// Sets size_, and what rests aside. Returns whether that is clear.
  bool find_moving() {
    size_.assign(state_.size(), 0);
    for (int sample = 0; sample < kSamples; ++sample) {
      std::vector<double> r(x_.size());
      for (double& value : r) value = random_.normal();
      const std::vector<double> reach = by_group(projected(std::move(r)));
      for (std::size_t g = 0; g < reach.size(); ++g) size_[g] = std::hypot(size_[g], reach[g]);
    }
    for (std::size_t g = 0; g < size_.size(); ++g) {
      if (size_[g] > tolerance::kPartClear) continue;
      if (!(size_[g] <= tolerance::kPartRounding)) return false;  // also where the factor broke down
      state_[g] = State::kDone;
    }
    return true;
  }

  /// Adds to what grows the groups where P r is not 0, and ends what grows no more. Returns how many parts
  /// ended, −1 if one does not clearly.
  int grow() {
    const std::vector<double> reach = by_group(projected(random_on_growing()));
    std::vector<bool> grows(elements(), false), is_doubtful(elements(), false), ends(elements(), false);
    for (std::size_t g = 0; g < state_.size(); ++g) {
      if (state_[g] != State::kFree) continue;
      if (reach[g] > tolerance::kPartClear * size_[g]) {
        state_[g] = State::kGrowing;
        grows[region(g)] = true;
      } else if (!(reach[g] <= tolerance::kPartRounding * size_[g])) {
        is_doubtful[region(g)] = true;
      }
    }
    for (std::size_t g = 0; g < state_.size(); ++g) {
      if (state_[g] != State::kGrowing || grows[region(g)]) continue;
      if (is_doubtful[region(g)]) return -1;
      state_[g] = State::kDone;
      ends[region(g)] = true;
    }
    return static_cast<int>(std::count(ends.begin(), ends.end(), true));
  }

  /// Joins the groups that are not done with the nodes that they touch.
  void join_regions() {
    regions_ = DisjointSets(elements());
    for (std::size_t g = 0; g < state_.size(); ++g) {
      if (state_[g] == State::kDone) continue;
      const BlockStructure::Group& group = structure_.groups()[g];
      for (int t = group.first_touch; t < group.end_touch; ++t)
        regions_.join(state_.size() + index(structure_.touches()[index(t)].node), g);
    }
  }
  /// Returns whether something grows, in regions where nothing did from their first group on.
  bool start_in_each_region() {
    std::vector<bool> grows(elements(), false);
    for (std::size_t g = 0; g < state_.size(); ++g) {
      if (state_[g] == State::kGrowing) grows[region(g)] = true;
    }
    for (std::size_t g = 0; g < state_.size(); ++g) {
      if (state_[g] != State::kFree || grows[region(g)]) continue;
      grows[region(g)] = true;
      state_[g] = State::kGrowing;
    }
    return std::find(grows.begin(), grows.end(), true) != grows.end();
  }

  std::size_t region(std::size_t group) { return regions_.root(group); }
  std::size_t elements() const { return state_.size() + index(structure_.nodes()); }

  std::vector<double> random_on_growing() {
    std::vector<double> r(x_.size(), 0);
    for (std::size_t g = 0; g < state_.size(); ++g) {
      if (state_[g] != State::kGrowing) continue;
      const BlockStructure::Group& group = structure_.groups()[g];
      for (int e = 0; e < group.columns; ++e) r[index(group.first_column + e)] = random_.normal();
    }
    return r;
  }

  /// P r.
  std::vector<double> projected(std::vector<double> r) const {
    std::vector<double> forces(r.size());
    for (int k = 0; k < kProjections; ++k) {
      for (std::size_t i = 0; i < r.size(); ++i) forces[i] = x_[i] * r[i];
      std::vector<double> y = product(structure_, forces);
      cholesky_.solve(y);
      const std::vector<double> along = transposed_product(structure_, y);
      for (std::size_t i = 0; i < r.size(); ++i) r[i] -= x_[i] * along[i];
    }
    return r;
  }

  /// The length of each group's part.
  std::vector<double> by_group(const std::vector<double>& v) const {
    std::vector<double> result;
    for (const BlockStructure::Group& group : structure_.groups()) {
      double length = 0;
      for (int e = 0; e < group.columns; ++e) length = std::hypot(length, v[index(group.first_column + e)]);
      result.push_back(length);
    }
    return result;
  }

  const BlockStructure& structure_;
  std::span<const double> x_;
  BlockCholesky cholesky_;  ///< of A X² Aᵀ
  Random random_{1};
  std::vector<State> state_;  ///< of each group
  std::vector<double> size_;  ///< of each group: its rows of P, but for chance
  DisjointSets regions_{0};   ///< of groups, then of nodes
};

}  // namespace

IndependentParts find_independent_parts(const BlockStructure& structure, std::span<const double> x) {
  return PartSearch(structure, x).run();
}

}  // namespace indet::barrier
