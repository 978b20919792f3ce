#pragma once

#include <concepts>
#include <cstddef>
#include <numeric>
#include <vector>

namespace indet {

/// Disjoint sets of the elements 0 … size − 1, at first one an element: those that are joined have the same
/// root, one of them.
class DisjointSets {
 public:
  explicit DisjointSets(std::integral auto size) : parent_(static_cast<std::size_t>(size)) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t root(std::integral auto element) {
    auto i = static_cast<std::size_t>(element);
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// The root of both becomes that of `b`.
  void join(std::integral auto a, std::integral auto b) { parent_[root(a)] = root(b); }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace indet
