#include "libindet/nullspace/null_space.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "libindet/base/tolerances.h"
#include "libindet/nullspace/lapack.h"
#include "libindet/nullspace/sparse_qr.h"

namespace indet {
namespace {

/// Above this many unknowns a dense singular value decomposition takes minutes; the doubt is then reported,
/// not resolved.
constexpr Eigen::Index kDenseLimit = 2500;

/// ‖c‖₂ ≤ √(‖c‖₁ ‖c‖_∞): the scale against which singular values count as zero.
double norm_bound(const Eigen::SparseMatrix<double>& matrix) {
  Eigen::VectorXd rows = Eigen::VectorXd::Zero(matrix.rows());
  double columns = 0;
  for (Eigen::Index j = 0; j < matrix.outerSize(); ++j) {
    double column = 0;
    for (Eigen::SparseMatrix<double>::InnerIterator it(matrix, j); it; ++it) {
      column += std::abs(it.value());
      rows[it.row()] += std::abs(it.value());
    }
    columns = std::max(columns, column);
  }
  const double bound = rows.size() > 0 ? std::sqrt(rows.maxCoeff() * columns) : 0;
  return bound > 0 ? bound : 1;
}

/// Replaces the sparse result by one from the singular values.
void decide_by_singular_values(const Eigen::SparseMatrix<double>& matrix, const Eigen::VectorXd& b,
                               double scale, NullSpace& result) {
  const SingularValueDecomposition svd = decompose_singular_values(Eigen::MatrixXd(matrix));
  const Eigen::VectorXd& sigma = svd.sigma;
  result.singular_values = sigma;
  const auto accepted = [&](double value) { return value > tolerance::kRankReject * scale; };
  result.rank = static_cast<int>(std::count_if(sigma.begin(), sigma.end(), accepted));
  result.nullity = static_cast<int>(matrix.cols()) - result.rank;
  result.basis = svd.V.rightCols(result.nullity);
  result.smallest_accepted =
      result.rank > 0 ? sigma[result.rank - 1] : std::numeric_limits<double>::infinity();
  result.largest_rejected = result.rank < sigma.size() ? sigma[result.rank] : 0;
  result.ambiguous = result.smallest_accepted < tolerance::kRankAccept * scale ||
                     result.largest_rejected > tolerance::kNoise * scale;

  const Eigen::VectorXd projected = svd.U.leftCols(result.rank).transpose() * b;
  result.particular = svd.V.leftCols(result.rank) * projected.cwiseQuotient(sigma.head(result.rank));
  result.independent_rows = column_order(Eigen::MatrixXd(matrix.transpose()));
  result.independent_rows.resize(static_cast<std::size_t>(result.rank));
  std::sort(result.independent_rows.begin(), result.independent_rows.end());
}

}  // namespace

RankDecision decide_rank(const Eigen::SparseMatrix<double>& matrix) {
  RankDecision decision;
  decision.nullity = static_cast<int>(matrix.cols());
  decision.smallest_accepted = std::numeric_limits<double>::infinity();
  if (matrix.rows() == 0 || matrix.cols() == 0) return decision;
  const double scale = norm_bound(matrix);
  decision.qr = std::make_shared<SparseQr>(matrix.transpose(), tolerance::kRankReject * scale);
  decision.rank = decision.qr->rank();
  decision.nullity -= decision.rank;
  decision.smallest_accepted = decision.qr->smallest_accepted();
  decision.largest_rejected = decision.qr->dropped_norm();
  decision.ambiguous = decision.smallest_accepted < tolerance::kRankAccept * scale ||
                       decision.largest_rejected > tolerance::kNoise * scale;
  decision.independent_rows = decision.qr->independent_columns();
  return decision;
}

NullSpace compute_null_space(const Eigen::SparseMatrix<double>& matrix, const Eigen::VectorXd& b) {
  NullSpace result;
  static_cast<RankDecision&>(result) = decide_rank(matrix);
  if (!result.qr) {
    result.basis = Eigen::MatrixXd::Identity(matrix.cols(), matrix.cols());
    result.particular = Eigen::VectorXd::Zero(matrix.cols());
    if (b.size() > 0 && b.cwiseAbs().maxCoeff() > 0) result.unbalanced = -b;
    return result;
  }
  const double scale = norm_bound(matrix);
  const SparseQr& qr = *result.qr;
  if (result.ambiguous && std::max(matrix.rows(), matrix.cols()) <= kDenseLimit) {
    decide_by_singular_values(matrix, b, scale, result);
  } else {
    result.basis = qr.left_kernel();
    result.particular = qr.solve_transposed(b);
    result.particular += qr.solve_transposed(b - matrix * result.particular);  // one step of refinement
    result.particular -= result.basis * (result.basis.transpose() * result.particular);
  }

  // The residual that is left is orthogonal to the range of c only in part: project it onto the left kernel.
  const Eigen::VectorXd residual = matrix * result.particular - b;
  const double allowed =
      tolerance::kUnbalancedLoad * std::max(1.0, result.particular.lpNorm<Eigen::Infinity>());
  if (residual.lpNorm<Eigen::Infinity>() > allowed && result.rank < matrix.rows()) {
    const Eigen::MatrixXd left = SparseQr(matrix, tolerance::kRankReject * scale).left_kernel();
    const Eigen::VectorXd unbalanced = left * (left.transpose() * -b);
    if (unbalanced.lpNorm<Eigen::Infinity>() > tolerance::kUnbalancedLoad) result.unbalanced = unbalanced;
  }
  return result;
}

Eigen::VectorXd motion_from_contacts(const NullSpace& null_space, int equations, const Eigen::VectorXd& q) {
  return null_space.qr ? null_space.qr->solve(q) : Eigen::VectorXd::Zero(equations);
}

Eigen::MatrixXd right_inverse(const NullSpace& null_space, const Eigen::SparseMatrix<double>& matrix) {
  const std::vector<int>& rows = null_space.independent_rows;
  const auto rank = static_cast<Eigen::Index>(rows.size());
  if (rank == 0) return Eigen::MatrixXd(matrix.cols(), 0);
  if (null_space.qr->independent_columns() == rows) {
    Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(matrix.rows(), rank);
    for (Eigen::Index k = 0; k < rank; ++k) unit(rows[static_cast<std::size_t>(k)], k) = 1;
    return null_space.qr->solve_transposed_columns(unit);
  }
  // The singular values have overruled the sparse decomposition.
  Eigen::SparseMatrix<double> selection(matrix.rows(), rank);
  for (Eigen::Index k = 0; k < rank; ++k) selection.insert(rows[static_cast<std::size_t>(k)], k) = 1;
  const Eigen::SparseMatrix<double> columns = matrix.transpose() * selection;
  return SparseQr(columns, 0).solve_transposed_columns(Eigen::MatrixXd::Identity(rank, rank));
}

}  // namespace indet
