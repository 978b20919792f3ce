#include "libindet/nullspace/lapack.h"

#include <lapacke.h>

#include <algorithm>
#include <string>

#include "libindet/base/error.h"

namespace indet {
namespace {

void check(lapack_int info, const char* routine) {
  if (info == 0) return;
  throw LibraryError(std::string("LAPACK's ") + routine + " failed (info " + std::to_string(info) + ")");
}

}  // namespace

SingularValueDecomposition decompose_singular_values(Eigen::MatrixXd matrix) {
  const auto m = static_cast<lapack_int>(matrix.rows());
  const auto n = static_cast<lapack_int>(matrix.cols());
  SingularValueDecomposition result{Eigen::MatrixXd(m, m), Eigen::VectorXd(std::min(m, n)),
                                    Eigen::MatrixXd(n, n)};
  check(LAPACKE_dgesdd(LAPACK_COL_MAJOR, 'A', m, n, matrix.data(), m, result.sigma.data(), result.U.data(), m,
                       result.V.data(), n),
        "dgesdd");
  result.V.transposeInPlace();  // LAPACK gives Vᵀ
  return result;
}

std::vector<int> column_order(Eigen::MatrixXd matrix) {
  const auto m = static_cast<lapack_int>(matrix.rows());
  const auto n = static_cast<lapack_int>(matrix.cols());
  std::vector<lapack_int> order(static_cast<std::size_t>(n), 0);  // 0: free to move
  Eigen::VectorXd reflectors(std::min(m, n));
  check(LAPACKE_dgeqp3(LAPACK_COL_MAJOR, m, n, matrix.data(), m, order.data(), reflectors.data()), "dgeqp3");
  std::vector<int> result(order.begin(), order.end());
  for (int& column : result) --column;  // LAPACK counts from 1
  return result;
}

}  // namespace indet
