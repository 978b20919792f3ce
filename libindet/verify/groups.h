#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <numeric>
#include <vector>

namespace indet {

/// Disjoint sets of the elements 0 … size − 1: those that are joined have the same root.
class Groups {
 public:
  explicit Groups(Eigen::Index size) : parent_(static_cast<std::size_t>(size)) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  std::size_t root(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(Eigen::Index i, Eigen::Index j) {
    parent_[root(static_cast<std::size_t>(i))] = root(static_cast<std::size_t>(j));
  }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace indet
