#include "libindet/exact/ray.h"

#include <algorithm>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "libindet/base/sparse_lu.h"
#include "libindet/base/tolerances.h"
#include "libindet/exact/basis_solver.h"

namespace indet::exact {
namespace {

constexpr int kSteps = 3;  ///< each makes A x some 1e10 times smaller

/// Calls visit(number of the row, entry) for the entries of a column on the numbered rows. Its true entries
/// are these times 2^−shift.
template <class Visit>
void for_each_entry(const IntegerColumn& column, const std::vector<int>& row_number, Visit visit) {
  for (std::size_t k = 0; k < column.row.size(); ++k) {
    const int row = row_number[static_cast<std::size_t>(column.row[k])];
    if (row >= 0) visit(row, column.value[k]);
  }
}

/// Strengths x that nearly balance themselves on some independent rows J, moved by
///
///   −A_Jᵀ (A_J A_Jᵀ)⁻¹ A_J x
class LeastMove {
 public:
  LeastMove(const std::vector<const IntegerColumn*>& columns, const std::vector<int>& row_number, int rows)
      : rows_(static_cast<std::size_t>(rows)), row_number_(row_number), columns_(columns) {
    std::map<std::pair<int, int>, double> products;  // by column and row
    for (const IntegerColumn* column : columns) {
      std::vector<std::pair<int, double>> entries;
      for_each_entry(*column, row_number, [&](int row, const mpz_class& value) {
        entries.emplace_back(row, scaled(mpq_class(value), -column->shift).get_d());
      });
      for (const auto& [i, a] : entries) {
        for (const auto& [j, b] : entries) products[{j, i}] += a * b;
      }
      entries_.push_back(std::move(entries));
    }
    std::vector<int> first(rows_ + 1, 0), row;
    std::vector<double> values;
    for (const auto& [place, value] : products) {
      ++first[static_cast<std::size_t>(place.first) + 1];
      row.push_back(place.second);
      values.push_back(value);
    }
    for (std::size_t j = 0; j < rows_; ++j) first[j + 1] += first[j];
    is_regular_ = !lu_.factor(first, row, values);
  }

  void move(std::vector<mpq_class>& x) const {
    for (int step = 0; is_regular_ && step < kSteps; ++step) {
      std::vector<mpq_class> left(rows_);
      for (std::size_t j = 0; j < x.size(); ++j) {
        const mpq_class strength = scaled(x[j], -columns_[j]->shift);
        for_each_entry(*columns_[j], row_number_, [&](int row, const mpz_class& value) {
          left[static_cast<std::size_t>(row)] += value * strength;
        });
      }
      std::vector<double> multipliers;
      for (const mpq_class& value : left) multipliers.push_back(value.get_d());
      lu_.solve(multipliers);
      for (std::size_t j = 0; j < x.size(); ++j) {
        double change = 0;
        for (const auto& [row, value] : entries_[j])
          change += value * multipliers[static_cast<std::size_t>(row)];
        x[j] -= mpq_class(change);
      }
    }
  }

 private:
  std::size_t rows_;
  const std::vector<int>& row_number_;
  const std::vector<const IntegerColumn*>& columns_;
  std::vector<std::vector<std::pair<int, double>>> entries_;
  SparseLu lu_;
  bool is_regular_ = false;
};

}  // namespace

struct RaysOnEdges::Impl {
  std::vector<int> edges;       ///< ascending
  std::vector<int> basic;       ///< places among them of those that follow from the others
  std::vector<int> number;      ///< of each edge its number among these, −1: it is free
  std::vector<int> row_number;  ///< among the independent rows
  std::vector<const IntegerColumn*> columns;
  std::vector<IntegerColumn> square;
  std::vector<Terms> other_rows;  ///< of each row that follows from the independent ones
  std::unique_ptr<LeastMove> least_move;
  std::unique_ptr<BasisSolver> solver;
};

RaysOnEdges::RaysOnEdges(const ContactProblem& problem, std::vector<int> edges,
                         std::span<const double> preference)
    : impl_(std::make_unique<Impl>()) {
  Impl& its = *impl_;
  its.edges = std::move(edges);
  std::vector<bool> open(static_cast<std::size_t>(problem.edges()), false);
  for (const int e : its.edges) {
    its.columns.push_back(&problem.edge(e));
    open[static_cast<std::size_t>(e)] = true;
  }
  const ContactProblem cone = problem.restricted_to(open);
  if (cone.rank() == std::ssize(its.edges)) return;
  its.row_number = cone.row_number();
  its.number.assign(its.edges.size(), -1);
  for (const int e : cone.choose_basis(preference)) {
    const auto place = std::lower_bound(its.edges.begin(), its.edges.end(), e) - its.edges.begin();
    its.number[static_cast<std::size_t>(place)] = static_cast<int>(its.basic.size());
    its.basic.push_back(static_cast<int>(place));
  }
  if (std::ssize(its.basic) != cone.rank()) return;
  its.square.resize(its.basic.size());
  its.other_rows.resize(static_cast<std::size_t>(problem.rows()));
  for (std::size_t c = 0; c < its.basic.size(); ++c) {
    const IntegerColumn& column = *its.columns[static_cast<std::size_t>(its.basic[c])];
    its.square[c].shift = column.shift;
    for (std::size_t k = 0; k < column.row.size(); ++k) {
      const auto place = static_cast<std::size_t>(column.row[k]);
      const int row = its.row_number[place];
      if (row >= 0) {
        its.square[c].row.push_back(row);
        its.square[c].value.push_back(column.value[k]);
      } else {
        its.other_rows[place].emplace_back(static_cast<int>(c), scaled(column.value[k], -column.shift));
      }
    }
  }
  std::vector<const IntegerColumn*> pointers;
  for (const IntegerColumn& column : its.square) pointers.push_back(&column);
  its.solver = BasisSolver::create(std::move(pointers));
  its.least_move = std::make_unique<LeastMove>(its.columns, its.row_number, cone.rank());
}
RaysOnEdges::~RaysOnEdges() = default;

bool RaysOnEdges::contain_one_near(std::span<const double> guess) const {
  const Impl& its = *impl_;
  if (!its.solver) return false;
  std::vector<mpq_class> x, low, high;
  double largest = 0;
  for (const int e : its.edges) largest = std::max(largest, guess[static_cast<std::size_t>(e)]);
  const mpq_class near(tolerance::kRayEntry * largest);
  for (const int e : its.edges) {
    x.emplace_back(guess[static_cast<std::size_t>(e)]);
    low.push_back(std::max(mpq_class(0), mpq_class(x.back() - near)));
    high.push_back(x.back() + near);
  }
  its.least_move->move(x);
  // What the free ones leave to the others, of all rows.
  std::vector<mpq_class> right(its.row_number.size());
  for (std::size_t j = 0; j < its.columns.size(); ++j) {
    if (its.number[j] >= 0) continue;
    if (x[j] <= low[j] || x[j] >= high[j]) return false;
    const IntegerColumn& column = *its.columns[j];
    const mpq_class strength = scaled(x[j], -column.shift);
    for (std::size_t k = 0; k < column.row.size(); ++k)
      right[static_cast<std::size_t>(column.row[k])] -= column.value[k] * strength;
  }
  mpz_class denominator = 1;
  for (const mpq_class& value : right) denominator = lcm(denominator, value.get_den());
  std::vector<mpz_class> on_rows(its.basic.size());
  for (std::size_t i = 0; i < right.size(); ++i) {
    right[i] *= denominator;
    if (its.row_number[i] >= 0) on_rows[static_cast<std::size_t>(its.row_number[i])] = right[i].get_num();
  }
  const Solution others = its.solver->solve(std::move(on_rows));
  for (std::size_t c = 0; c < its.basic.size(); ++c) {
    const IntegerColumn itself{{static_cast<int>(c)}, {1}, 0};
    const auto j = static_cast<std::size_t>(its.basic[c]);
    if (others.compare(itself, low[j] * denominator) <= 0) return false;
    if (others.compare(itself, high[j] * denominator) >= 0) return false;
  }
  for (std::size_t i = 0; i < right.size(); ++i) {
    if (its.row_number[i] >= 0) continue;
    const Terms& row = its.other_rows[i];
    if (row.empty() ? right[i] != 0 : others.compare(integer_terms(row), right[i]) != 0) return false;
  }
  return true;
}

std::vector<int> loaded_edges(const ContactProblem& problem, std::span<const double> guess, double zero) {
  std::vector<int> edges;
  for (int e = 0; e < problem.edges(); ++e) {
    if (problem.has_edge(e) && guess[static_cast<std::size_t>(e)] > zero) edges.push_back(e);
  }
  return edges;
}

bool proves_ray(const ContactProblem& problem, std::span<const double> guess, double zero) {
  const std::vector<double> alike(static_cast<std::size_t>(problem.edges()), 0.0);
  return RaysOnEdges(problem, loaded_edges(problem, guess, zero), alike).contain_one_near(guess);
}

}  // namespace indet::exact
