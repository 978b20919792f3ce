#include "libindet/pivoting/tableau.h"

#include <algorithm>
#include <cmath>

#include "libindet/base/random.h"
#include "libindet/base/tolerances.h"
#include "libindet/dense/lu.h"

// The inner loops are compiled for wider registers too. Each element is computed by itself and without fused
// multiply-add, so the width does not change a result.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define INDET_WIDE __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define INDET_WIDE
#endif

namespace indet {
namespace {

/// Updates of the weights before they are computed anew, which costs as much as a pivot. Errors made where an
/// edge is long stay when it is short again.
constexpr int kWeightUpdates = 32;

/// y += f · x.
INDET_WIDE void add_multiple(double* y, const double* x, double f, Eigen::Index n) {
  for (Eigen::Index j = 0; j < n; ++j) y[j] += f * x[j];
}

/// p += f · y, then y += f · x.
INDET_WIDE void project_and_add(double* y, const double* x, double* p, double f, Eigen::Index n) {
  for (Eigen::Index j = 0; j < n; ++j) {
    p[j] += f * y[j];
    y[j] += f * x[j];
  }
}

}  // namespace

Tableau::Tableau(const SlopeView& view, bool with_weights) : view_(view), with_weights_(with_weights) {
  Random random(1);
  Eigen::VectorXd u(view.dim());
  for (double& value : u) value = random.uniform(-1, 1);
  probe_ = view.slope * u;
}

bool Tableau::build(const Basis& basis) {
  active_ = basis;
  slack_.clear();
  std::vector<bool> is_active(static_cast<std::size_t>(view_.inequalities()), false);
  for (const int k : basis) is_active[static_cast<std::size_t>(k)] = true;
  for (int k = 0; k < view_.inequalities(); ++k) {
    if (!is_active[static_cast<std::size_t>(k)]) slack_.push_back(k);
  }
  const Eigen::MatrixXd rows = view_.slope(active_, Eigen::all);
  const Eigen::PartialPivLU<Eigen::MatrixXd> factors(rows.transpose());
  const auto pivots = factors.matrixLU().diagonal().cwiseAbs();
  if (!(pivots.minCoeff() > tolerance::kSingularExchange * pivots.maxCoeff())) {
    active_.clear();
    return false;
  }
  rates_ = factors.solve(view_.slope(slack_, Eigen::all).transpose()).transpose();
  column_.resize(rates_.rows());
  update_positions();
  recompute_slacks();
  recompute_weights();
  return true;
}

bool Tableau::move_to(const Basis& basis) {
  if (!is_built()) return build(basis);
  std::vector<int> rows;
  std::vector<bool> wanted(static_cast<std::size_t>(view_.inequalities()), false);
  for (const int k : basis) {
    wanted[static_cast<std::size_t>(k)] = true;
    if (row_of(k) >= 0) rows.push_back(row_of(k));
  }
  if (rows.empty()) {
    recompute_slacks();
    recompute_weights();
    return true;
  }
  // An exchange of m inequalities multiplies (K − d) × m × (d − m), factorising anew (K − d) × d × d / 2.
  if (2 * rows.size() > active_.size()) return build(basis);
  std::vector<int> columns;
  for (std::size_t j = 0; j < active_.size(); ++j) {
    if (!wanted[static_cast<std::size_t>(active_[j])]) columns.push_back(static_cast<int>(j));
  }
  const Eigen::PartialPivLU<Eigen::MatrixXd> corner(Eigen::MatrixXd(rates_(rows, columns)));
  const auto pivots = corner.matrixLU().diagonal().cwiseAbs();
  if (!(pivots.minCoeff() > tolerance::kSingularExchange * std::max(1.0, pivots.maxCoeff())))
    return build(basis);
  exchange(rows, columns);
  return true;
}

void Tableau::exchange(const std::vector<int>& rows, const std::vector<int>& columns) {
  // With P the rows and Q the columns that change places, and R the other columns:
  //   x_Q = D_PQ⁻¹ (x_P − b_P − D_PR x_R), put into all other rows.
  const Eigen::MatrixXd corner = rates_(rows, columns);
  const Eigen::PartialPivLU<Eigen::MatrixXd> factors(corner.transpose());
  const Eigen::MatrixXd left = rates_(Eigen::all, columns);
  Eigen::MatrixXd weights = factors.solve(left.transpose()).transpose();  // D_iQ D_PQ⁻¹
  weights(rows, Eigen::all).setZero();
  const Eigen::PartialPivLU<Eigen::MatrixXd> solver(corner);
  Matrix swapped = -solver.solve(Eigen::MatrixXd(rates_(rows, Eigen::all)));
  swapped(Eigen::all, columns) = Matrix(solver.inverse());
  Matrix pivot_rows = rates_(rows, Eigen::all);
  pivot_rows(Eigen::all, columns).setZero();
  rates_(Eigen::all, columns).setZero();
  rates_.noalias() -= weights * pivot_rows;
  rates_(Eigen::all, columns) += weights;
  rates_(rows, Eigen::all) = swapped;
  for (std::size_t i = 0; i < rows.size(); ++i)
    std::swap(slack_[static_cast<std::size_t>(rows[i])], active_[static_cast<std::size_t>(columns[i])]);
  update_positions();
  recompute_slacks();
  recompute_weights();
}

void Tableau::pivot(int r, int q) {
  const Eigen::Index d = rates_.cols();
  const double inverse = 1 / rates_(r, q);
  column_ = rates_.col(q);
  row_ = rates_.row(r) * -inverse;
  row_[q] = inverse;
  const double slack = -slacks_[r] * inverse;
  if (with_weights_) product_.setZero(d);
  for (Eigen::Index i = 0; i < rates_.rows(); ++i) {
    const double factor = column_[i];
    if (i == r || std::abs(factor) <= tolerance::kTableauZero) continue;
    double* const row = rates_.row(i).data();
    row[q] = 0;  // the new entry is factor · inverse alone
    if (with_weights_) {
      project_and_add(row, row_.data(), product_.data(), factor, d);
    } else {
      add_multiple(row, row_.data(), factor, d);
    }
    slacks_[i] += factor * slack;
  }
  if (with_weights_) {
    // γ of a column D_j + t_j D_q, t_j = −D_rj / D_rq, in which row r gives way to the row of x_q.
    const double leaving = weights_[q];
    for (Eigen::Index j = 0; j < d; ++j) {
      if (j == q || row_[j] == 0) continue;
      const double through = product_[j] - column_[r] * column_[r] * row_[j];  // Σ over all rows of D_ij D_iq
      const double updated = weights_[j] + row_[j] * (2 * through + row_[j] * leaving);
      weights_[j] = std::max(updated, 1 + row_[j] * row_[j]);
    }
    weights_[q] = std::max(leaving * inverse * inverse, 1.0);
  }
  rates_.row(r) = row_.transpose();
  if (with_weights_ && ++weight_updates_ >= kWeightUpdates) recompute_weights();
  slacks_[r] = slack;
  std::swap(slack_[static_cast<std::size_t>(r)], active_[static_cast<std::size_t>(q)]);
  position_[static_cast<std::size_t>(slack_[static_cast<std::size_t>(r)])] = {r, -1};
  position_[static_cast<std::size_t>(active_[static_cast<std::size_t>(q)])] = {-1, q};
}

double Tableau::error() const {
  const Eigen::VectorXd at_active = probe_(active_);
  const Eigen::VectorXd difference = rates_ * at_active - probe_(slack_);
  return difference.size() > 0 ? difference.lpNorm<Eigen::Infinity>() / probe_.lpNorm<Eigen::Infinity>() : 0;
}

void Tableau::recompute_slacks() {
  const Eigen::VectorXd at_active = view_.offset(active_);
  slacks_ = view_.offset(slack_);
  slacks_.noalias() -= rates_ * at_active;
}

void Tableau::recompute_weights() {
  weight_updates_ = 0;
  if (with_weights_) weights_ = (1 + rates_.colwise().squaredNorm().transpose().array()).matrix();
}

Eigen::VectorXd Tableau::gradient(const Objective& objective) const {
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(rates_.cols());
  for (const auto& [inequality, coefficient] : objective.on_edges) {
    const Position& position = position_[static_cast<std::size_t>(inequality)];
    if (position.row >= 0) {
      gradient += coefficient * rates_.row(position.row).transpose();
    } else {
      gradient[position.column] += coefficient;
    }
  }
  return gradient;
}

Basis Tableau::basis() const {
  Basis basis = active_;
  std::sort(basis.begin(), basis.end());
  return basis;
}

void Tableau::update_positions() {
  position_.assign(static_cast<std::size_t>(view_.inequalities()), {});
  for (std::size_t i = 0; i < slack_.size(); ++i)
    position_[static_cast<std::size_t>(slack_[i])].row = static_cast<int>(i);
  for (std::size_t j = 0; j < active_.size(); ++j)
    position_[static_cast<std::size_t>(active_[j])].column = static_cast<int>(j);
}

}  // namespace indet
