#include "libindet/lp/independent_equations.h"

#include <vector>

namespace indet {

FeasibleSet independent_equations(const Eigen::SparseMatrix<double>& equations, std::span<const int> rows,
                                  const Eigen::VectorXd& point) {
  std::vector<int> number(static_cast<std::size_t>(equations.rows()), -1);
  for (std::size_t i = 0; i < rows.size(); ++i)
    number[static_cast<std::size_t>(rows[i])] = static_cast<int>(i);
  std::vector<Eigen::Triplet<double>> kept;
  for (int k = 0; k < equations.outerSize(); ++k) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(equations, k); it; ++it) {
      const int row = number[static_cast<std::size_t>(it.row())];
      if (row >= 0) kept.emplace_back(row, k, it.value());
    }
  }
  FeasibleSet set;
  set.equations.resize(static_cast<Eigen::Index>(rows.size()), equations.cols());
  set.equations.setFromTriplets(kept.begin(), kept.end());
  set.right_hand_side = set.equations * point;
  return set;
}

}  // namespace indet
