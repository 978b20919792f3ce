#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <span>

#include "libindet/lp/feasible_set.h"

namespace indet {

/// {x ≥ 0 : (A x)_i = (A p)_i for i in `rows`}, A the `equations` and p a point that solves them.
/// Preconditions: the rows are independent, and the others follow from them.
FeasibleSet independent_equations(const Eigen::SparseMatrix<double>& equations, std::span<const int> rows,
                                  const Eigen::VectorXd& point);

}  // namespace indet
