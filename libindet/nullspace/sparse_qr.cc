#include "libindet/nullspace/sparse_qr.h"

#include <dlfcn.h>

#include <SuiteSparseQR.hpp>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "libindet/base/error.h"

namespace indet {
namespace {

/// OpenBLAS starts threads of its own, which fronts of this size do not repay, and which fight with ours for
/// the processors. Other libraries that provide BLAS have no such function.
void keep_blas_on_one_thread() {
  using SetThreads = void (*)(int);
  static const auto set_threads =
      reinterpret_cast<SetThreads>(dlsym(RTLD_DEFAULT, "openblas_set_num_threads"));
  if (set_threads != nullptr) set_threads(1);
}

/// A CHOLMOD workspace; every SPQR object needs one, and it must outlive them.
class Workspace {
 public:
  Workspace() {
    keep_blas_on_one_thread();
    cholmod_l_start(&common_);
    common_.print = 0;
    common_.SPQR_nthreads = 1;  // results must not depend on the number of threads
  }
  ~Workspace() { cholmod_l_finish(&common_); }
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;
  cholmod_common* get() { return &common_; }

  void check(const void* result, const char* what) const {
    if (result == nullptr || common_.status < CHOLMOD_OK) {
      throw LibraryError(std::string("sparse QR failed in ") + what + " (CHOLMOD status " +
                         std::to_string(common_.status) + ")");
    }
  }

 private:
  cholmod_common common_{};
};

}  // namespace

struct SparseQr::Impl {
  Workspace workspace;
  SuiteSparseQR_factorization<double>* factors = nullptr;
  Eigen::Index rows = 0;
  Eigen::Index columns = 0;

  Impl() = default;
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  ~Impl() {
    if (factors != nullptr) SuiteSparseQR_free(&factors, workspace.get());
  }

  struct DenseDeleter {
    cholmod_common* common;
    void operator()(cholmod_dense* dense) const { cholmod_l_free_dense(&dense, common); }
  };
  using Dense = std::unique_ptr<cholmod_dense, DenseDeleter>;

  Dense to_dense(const Eigen::MatrixXd& matrix) {
    cholmod_dense* raw = cholmod_l_allocate_dense(
        static_cast<std::size_t>(matrix.rows()), static_cast<std::size_t>(matrix.cols()),
        static_cast<std::size_t>(matrix.rows()), CHOLMOD_REAL, workspace.get());
    workspace.check(raw, "allocation");
    Eigen::Map<Eigen::MatrixXd>(static_cast<double*>(raw->x), matrix.rows(), matrix.cols()) = matrix;
    return Dense(raw, DenseDeleter{workspace.get()});
  }

  Eigen::MatrixXd from_dense(cholmod_dense* raw, const char* what) {
    workspace.check(raw, what);
    const Dense owner(raw, DenseDeleter{workspace.get()});
    return Eigen::Map<Eigen::MatrixXd>(static_cast<double*>(raw->x), static_cast<Eigen::Index>(raw->nrow),
                                       static_cast<Eigen::Index>(raw->ncol));
  }

  Eigen::MatrixXd multiply(int method, const Eigen::MatrixXd& x) {
    const Dense dense = to_dense(x);
    return from_dense(SuiteSparseQR_qmult<double>(method, factors, dense.get(), workspace.get()),
                      "Q multiply");
  }

  Eigen::MatrixXd triangular_solve(int system, const Eigen::MatrixXd& b) {
    const Dense dense = to_dense(b);
    return from_dense(SuiteSparseQR_solve<double>(system, factors, dense.get(), workspace.get()),
                      "triangular solve");
  }
};

SparseQr::SparseQr(const Eigen::SparseMatrix<double>& matrix, double tolerance)
    : impl_(std::make_unique<Impl>()) {
  Impl& impl = *impl_;
  impl.rows = matrix.rows();
  impl.columns = matrix.cols();
  Eigen::SparseMatrix<double, Eigen::ColMajor, SuiteSparse_long> copy(matrix);
  copy.makeCompressed();
  cholmod_sparse view{};
  view.nrow = static_cast<std::size_t>(copy.rows());
  view.ncol = static_cast<std::size_t>(copy.cols());
  view.nzmax = static_cast<std::size_t>(copy.nonZeros());
  view.p = copy.outerIndexPtr();
  view.i = copy.innerIndexPtr();
  view.x = copy.valuePtr();
  view.stype = 0;
  view.itype = CHOLMOD_LONG;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = 1;
  view.packed = 1;
  impl.factors =
      SuiteSparseQR_factorize<double>(SPQR_ORDERING_DEFAULT, tolerance, &view, impl.workspace.get());
  impl.workspace.check(impl.factors, "factorisation");
}

SparseQr::~SparseQr() = default;
SparseQr::SparseQr(SparseQr&&) noexcept = default;
SparseQr& SparseQr::operator=(SparseQr&&) noexcept = default;

int SparseQr::rank() const { return static_cast<int>(impl_->factors->rank); }

double SparseQr::dropped_norm() const {
  return rank() < impl_->columns ? impl_->factors->QRnum->norm_E_fro : 0.0;
}

std::vector<int> SparseQr::independent_columns() const {
  const auto* factors = impl_->factors;
  std::vector<int> columns;
  for (SuiteSparse_long j = 0; j < impl_->columns; ++j) {
    const bool live = factors->Rmap == nullptr ? j < factors->rank : factors->Rmap[j] < factors->rank;
    if (live) columns.push_back(static_cast<int>(factors->Q1fill == nullptr ? j : factors->Q1fill[j]));
  }
  std::sort(columns.begin(), columns.end());
  return columns;
}

Eigen::MatrixXd SparseQr::left_kernel() const {
  const Eigen::Index nullity = impl_->rows - rank();
  if (nullity == 0) return Eigen::MatrixXd(impl_->rows, 0);
  Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(impl_->rows, nullity);
  unit.bottomRows(nullity).setIdentity();
  return impl_->multiply(SPQR_QX, unit);
}

Eigen::VectorXd SparseQr::solve_transposed(const Eigen::VectorXd& b) const {
  if (rank() == 0) return Eigen::VectorXd::Zero(impl_->rows);
  return impl_->multiply(SPQR_QX, impl_->triangular_solve(SPQR_RTX_EQUALS_ETB, b));
}

Eigen::MatrixXd SparseQr::solve_transposed_columns(const Eigen::MatrixXd& b) const {
  if (rank() == 0) return Eigen::MatrixXd::Zero(impl_->rows, b.cols());
  return impl_->multiply(SPQR_QX, impl_->triangular_solve(SPQR_RTX_EQUALS_ETB, b));
}

Eigen::VectorXd SparseQr::solve(const Eigen::VectorXd& b) const {
  if (rank() == 0) return Eigen::VectorXd::Zero(impl_->columns);
  return impl_->triangular_solve(SPQR_RETX_EQUALS_B, impl_->multiply(SPQR_QTX, b));
}

double SparseQr::smallest_accepted() const {
  if (rank() == 0) return std::numeric_limits<double>::infinity();
  // A fixed, generic start vector; twelve steps give the order of magnitude, which is all that a gap needs.
  Eigen::VectorXd x(impl_->columns);
  for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = 1 + 0.5 * std::sin(1.7 * static_cast<double>(i));
  double estimate = std::numeric_limits<double>::infinity();
  for (int step = 0; step < 12; ++step) {
    const Eigen::VectorXd y = impl_->triangular_solve(SPQR_RTX_EQUALS_B, x.stableNormalized());
    x = impl_->triangular_solve(SPQR_RX_EQUALS_B, y);
    const double growth = x.stableNorm();
    if (!(growth > 0)) break;
    estimate = std::min(estimate, 1 / std::sqrt(growth));
  }
  return estimate;
}

}  // namespace indet
