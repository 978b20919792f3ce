#include "libindet/range/equation_bounds.h"

#include <cmath>
#include <span>

#include "libindet/base/constants.h"
#include "libindet/base/rounding_bounds.h"

namespace indet {
namespace {

/// The column of R is n̂, that of T is t̂ and l/r, of which l = r makes 1; other quotients are rounded, and so
/// is what both have in equations of stress.
bool has_stored_entries(const EquilibriumProblem& problem, const Edge& edge) {
  if (edge.is_slack()) return true;  // 1
  if (!problem.is_stick(edge)) return false;
  const ContactEnds& ends = problem.contacts[static_cast<std::size_t>(edge.contact.value())];
  return edge.sign > 0 || (ends.arm_a == 1 && ends.arm_b == 1);
}

}  // namespace

EquationBounds::EquationBounds(const ForcePolytope& polytope)
    : polytope_(polytope), problem_(polytope.problem), rows_(polytope.null_space->independent_rows) {
  restrict_to_independent_rows();
  bound_right_inverse();
}

void EquationBounds::restrict_to_independent_rows() {
  std::vector<int> number(static_cast<std::size_t>(problem_.equations()), -1);
  for (std::size_t k = 0; k < rows_.size(); ++k)
    number[static_cast<std::size_t>(rows_[k])] = static_cast<int>(k);
  const auto rank = static_cast<Eigen::Index>(rows_.size());
  const auto restricted = [&](const Eigen::SparseMatrix<double>& matrix) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int j = 0; j < matrix.outerSize(); ++j) {
      for (Eigen::SparseMatrix<double>::InnerIterator it(matrix, j); it; ++it) {
        const int row = number[static_cast<std::size_t>(it.row())];
        if (row >= 0) entries.emplace_back(row, j, it.value());
      }
    }
    Eigen::SparseMatrix<double> kept(rank, problem_.unknowns());
    kept.setFromTriplets(entries.begin(), entries.end());
    return kept;
  };
  matrix_ = restricted(problem_.matrix);
  edge_matrix_ = restricted(problem_.edge_matrix);
  load_.resize(rank);
  load_error_.resize(rank);
  for (Eigen::Index k = 0; k < rank; ++k) {
    const int row = rows_[static_cast<std::size_t>(k)];
    const EquilibriumRow& equation = problem_.rows[static_cast<std::size_t>(row)];
    is_stress_.push_back(equation.body.is_cell());
    load_[k] = problem_.load()[row];
    load_error_[k] = 6 * kRoundoff * equation.load / equation.unit + kTiny;
  }
  Eigen::VectorXd length = Eigen::VectorXd::Zero(rank);
  for (int j = 0; j < matrix_.outerSize(); ++j) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(matrix_, j); it; ++it) length[it.row()] += 1;
  }
  if (rank > 0) row_length_ = length.maxCoeff();
}

void EquationBounds::bound_right_inverse() {
  const int unknowns = problem_.unknowns();
  if (rank() == 0) {
    right_inverse_.resize(unknowns, 0);
    return;
  }
  right_inverse_ = indet::right_inverse(*polytope_.null_space, problem_.matrix);
  const Eigen::VectorXd sums = right_inverse_.cwiseAbs().rowwise().sum();
  const double norm = kWiden * sums.maxCoeff();
  const Eigen::MatrixXd product = matrix_ * right_inverse_;
  const Eigen::VectorXd off =
      (product - Eigen::MatrixXd::Identity(rank(), rank())).cwiseAbs().rowwise().sum();
  const Eigen::VectorXd magnitude = matrix_.cwiseAbs() * sums;
  const double longest = static_cast<double>(unknowns + 2);
  const double gamma =
      kWiden * (off + kRoundoff * (longest * magnitude + 8 * inexact_entries(sums))).maxCoeff();
  const bool all_rows = rank() == unknowns - polytope_.dim;
  gain_ = all_rows && gamma < 0.5 && std::isfinite(norm) ? kWiden * norm / (1 - gamma) : kInfinity;
}

Eigen::VectorXd EquationBounds::inexact_entries(const Eigen::VectorXd& weight) const {
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(rank());
  for (int j = 0; j < matrix_.outerSize(); ++j) {
    const bool stored = has_stored_entries(problem_, problem_.edge(j));
    for (Eigen::SparseMatrix<double>::InnerIterator it(matrix_, j); it; ++it) {
      if (!stored || is_stress_[static_cast<std::size_t>(it.row())])
        sums[it.row()] += entry_error(it.row()) * weight[j];
    }
  }
  return sums;
}

bool EquationBounds::is_proven() const { return std::isfinite(gain_); }

double EquationBounds::distance_to_solution(const Eigen::VectorXd& u) const {
  if (rank() == 0) return 0;
  const Eigen::VectorXd residual = (matrix_ * u - load_).cwiseAbs();
  const Eigen::VectorXd magnitude = matrix_.cwiseAbs() * u.cwiseAbs() + load_.cwiseAbs();
  const double terms = row_length_ + 2;
  const double worst =
      (residual + kRoundoff * (terms * magnitude + 8 * inexact_entries(u.cwiseAbs())) + load_error_)
          .maxCoeff() +
      kTiny;
  const double distance = kWiden * gain_ * worst;
  return std::isnan(distance) ? kInfinity : distance;
}

double EquationBounds::load_bound(const Eigen::VectorXd& y) const {
  const Dot dot = accurate_dot(std::span(y.data(), static_cast<std::size_t>(y.size())),
                               std::span(load_.data(), static_cast<std::size_t>(load_.size())));
  return dot.value + kWiden * (dot.error + y.cwiseAbs().dot(load_error_));
}

}  // namespace indet
