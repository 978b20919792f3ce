#pragma once

#include <gmpxx.h>

#include <optional>
#include <utility>
#include <vector>

#include "libindet/packing/packing.h"

namespace indet::oracle {

/// The ranges of a small packing by the textbook simplex method in rational numbers, for tests alone: a dense
/// tableau, Bland's rule, two phases. Nothing of it is shared with the libraries. The doubles of the packing
/// are taken as they are:
///
///   for each free disk  Σ χ (R n̂ + T t̂) = −(m g + load),  Σ l T = −load_z;
///   for each loaded wall  ΣR = load_n,  ΣT = load_t, as far as they are given;
///   R = p + q,  T = μ (p − q),  p, q ≥ 0
class RationalSimplex {
 public:
  /// Precondition: find_defect(packing) is empty.
  explicit RationalSimplex(const Packing& packing);

  /// Whether any admissible state exists.
  bool is_empty() const { return empty_; }
  /// The rank of the equations.
  int rank() const { return rank_; }
  /// Minimum (sign −1) or maximum (+1) of R_α (component 2α) or T_α (2α + 1); nothing: unbounded.
  /// Precondition: !is_empty().
  std::optional<mpq_class> extremum(int component, int sign);
  /// Of Σ coefficient · component, the coefficients taken as they are.
  std::optional<mpq_class> extremum(const std::vector<std::pair<int, double>>& terms, int sign);

 private:
  void pivot(std::size_t row, std::size_t column);
  /// Maximises costs·x from the present feasible basis; false if unbounded.
  bool maximise(const std::vector<mpq_class>& costs);
  void price(const std::vector<mpq_class>& costs);

  std::vector<mpq_class> mu_;
  std::vector<std::vector<mpq_class>> rows_;  ///< tableau, right-hand side last
  std::vector<std::size_t> basic_;
  std::vector<mpq_class> reduced_;  ///< costs − y·A, and minus the value
  std::size_t columns_ = 0;
  bool empty_ = false;
  int rank_ = 0;
};

}  // namespace indet::oracle
