#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "libindet/base/doubled_sum.h"
#include "libindet/polytope/force_polytope.h"
#include "libindet/range/functional.h"

namespace indet {

/// Numbers with bounds of their distance from the exact ones.
struct Bounded {
  Eigen::VectorXd value, error;
};
struct BoundedNumber {
  Doubled value;
  double error = 0;
};

/// The equations A x = b of a polytope on its edges in twice the precision of a double: entries are those of
/// the exact problem (polytope.exact) with the scales of polytope.problem, each within 16 u² of itself, and
/// the numbers of rows and columns are those of polytope.problem. What is returned holds for the exact A, b
/// and coefficients, whatever x and y are.
class DoubledEquations {
 public:
  /// Precondition: the polytope is not empty, and has its exact problem.
  explicit DoubledEquations(const ForcePolytope& polytope);

  int rows() const { return static_cast<int>(load_.size()); }
  int columns() const { return static_cast<int>(first_.size()) - 1; }

  struct Entry {
    int row = 0;
    Doubled value;
  };
  std::span<const Entry> column(int k) const {
    const auto begin = static_cast<std::size_t>(first_[static_cast<std::size_t>(k)]);
    return std::span(entries_).subspan(
        begin, static_cast<std::size_t>(first_[static_cast<std::size_t>(k) + 1]) - begin);
  }

  /// b − A x.
  Bounded residual(std::span<const Doubled> x) const;
  /// g − Aᵀ y. What has no term but zeros is exactly 0, with no error.
  Bounded reduced_costs(const DoubledFunctional& g, std::span<const Doubled> y) const;
  /// y · b.
  BoundedNumber load_product(std::span<const Doubled> y) const;
  /// g · x.
  static BoundedNumber value(const DoubledFunctional& g, std::span<const Doubled> x);

 private:
  std::vector<int> first_;  ///< of each column its first entry, and their number
  std::vector<Entry> entries_;
  std::vector<Doubled> load_;
};

}  // namespace indet
