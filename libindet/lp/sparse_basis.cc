#include "libindet/lp/sparse_basis.h"

#include <algorithm>

namespace indet {
namespace {

/// Pivots near those of partial pivoting: a vertex is judged by these numbers.
constexpr double kLeastShare = 0.1;

std::span<double> span_of(Eigen::VectorXd& v) { return {v.data(), static_cast<std::size_t>(v.size())}; }

}  // namespace

SparseBasis::SparseBasis(std::shared_ptr<const FeasibleSet> set, const Basis& basis)
    : set_(std::move(set)),
      active_(basis),
      place_(static_cast<std::size_t>(set_->inequalities()), 0),
      lu_(kLeastShare) {
  for (const int k : basis) place_[static_cast<std::size_t>(k)] = -1;
  for (int k = 0; k < set_->inequalities(); ++k) {
    int& place = place_[static_cast<std::size_t>(k)];
    if (place < 0) continue;
    place = static_cast<int>(basic_.size());
    basic_.push_back(k);
  }
}

std::shared_ptr<const SparseBasis> SparseBasis::factorise(std::shared_ptr<const FeasibleSet> set,
                                                          const Basis& basis) {
  std::shared_ptr<SparseBasis> result(new SparseBasis(std::move(set), basis));
  const Eigen::SparseMatrix<double>& equations = result->set_->equations;
  std::vector<int> first{0}, rows;
  std::vector<double> entries;
  for (const int k : result->basic_) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(equations, k); it; ++it) {
      rows.push_back(static_cast<int>(it.row()));
      entries.push_back(it.value());
    }
    first.push_back(static_cast<int>(rows.size()));
  }
  if (result->lu_.factor(first, rows, entries)) return {};
  return result;
}

Eigen::VectorXd SparseBasis::point() const {
  const auto solve = [this](Eigen::VectorXd right) {
    lu_.solve(span_of(right));
    return on_edges(right);
  };
  Eigen::VectorXd x = solve(set_->right_hand_side);
  x += solve(set_->right_hand_side - set_->equations * x);
  return x;
}

Eigen::VectorXd SparseBasis::edge(int k) const {
  const int active = active_[static_cast<std::size_t>(k)];
  Eigen::VectorXd right = -set_->equations.col(active);
  lu_.solve(span_of(right));
  Eigen::VectorXd direction = on_edges(right);
  direction[active] = 1;
  return direction;
}

Eigen::VectorXd SparseBasis::direction(const Eigen::VectorXd& rates) const {
  Eigen::VectorXd along = Eigen::VectorXd::Zero(set_->inequalities());
  along(active_) = rates;
  Eigen::VectorXd right = -(set_->equations * along);
  lu_.solve(span_of(right));
  along(basic_) = right;
  return along;
}

Eigen::VectorXd SparseBasis::multipliers(const std::vector<std::pair<int, double>>& on_edges) const {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(set_->equations.rows());
  Eigen::VectorXd costs = Eigen::VectorXd::Zero(std::ssize(active_));
  bool is_basic = false;
  for (const auto& [k, coefficient] : on_edges) {
    const int place = place_[static_cast<std::size_t>(k)];
    if (place >= 0) {
      y[place] += coefficient;
      is_basic = true;
    } else {
      costs[std::lower_bound(active_.begin(), active_.end(), k) - active_.begin()] -= coefficient;
    }
  }
  if (!is_basic) return costs;
  lu_.solve_transposed(span_of(y));
  for (std::size_t i = 0; i < active_.size(); ++i) {
    double along = 0;
    for (Eigen::SparseMatrix<double>::InnerIterator it(set_->equations, active_[i]); it; ++it)
      along += it.value() * y[it.row()];
    costs[static_cast<Eigen::Index>(i)] += along;
  }
  return costs;
}

/// x with the given basic strengths, 0 at the active inequalities.
Eigen::VectorXd SparseBasis::on_edges(const Eigen::VectorXd& basic) const {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(set_->inequalities());
  x(basic_) = basic;
  return x;
}

}  // namespace indet
