#pragma once

#include <Eigen/Core>
#include <vector>

namespace indet {

/// A = U diag(σ) Vᵀ (m × n) with square U and V; σ has min(m, n) entries, descending.
struct SingularValueDecomposition {
  Eigen::MatrixXd U;
  Eigen::VectorXd sigma;
  Eigen::MatrixXd V;
};

/// By LAPACK's divide and conquer (dgesdd); sparse_qr.h tells why BLAS runs on one thread. Precondition:
/// neither size is 0. Throws LibraryError when LAPACK fails (no convergence, out of memory).
SingularValueDecomposition decompose_singular_values(Eigen::MatrixXd matrix);

/// Columns of A in the order in which a QR factorisation takes them that prefers the largest remaining norm
/// (dgeqp3): the first rank(A) of them are linearly independent. Precondition and errors as above.
std::vector<int> column_order(Eigen::MatrixXd matrix);

}  // namespace indet
