#include "libindet/exact/ray.h"

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "libindet/base/sparse_lu.h"
#include "libindet/base/tolerances.h"
#include "libindet/exact/edge_span.h"

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
  Impl(const ContactProblem& problem, std::vector<int> given, std::span<const double> preference)
      : edges(std::move(given)), span(problem, edges, preference) {
    for (const int e : edges) columns.push_back(&problem.edge(e));
    if (span.has_basis())
      least_move.emplace(columns, span.row_number(), static_cast<int>(span.basis().size()));
  }

  std::vector<int> edges;  ///< ascending
  EdgeSpan span;           ///< what is not in its basis is free
  std::vector<const IntegerColumn*> columns;
  std::optional<LeastMove> least_move;
};

RaysOnEdges::RaysOnEdges(const ContactProblem& problem, std::vector<int> edges,
                         std::span<const double> preference)
    : impl_(std::make_unique<Impl>(problem, std::move(edges), preference)) {}
RaysOnEdges::~RaysOnEdges() = default;

bool RaysOnEdges::contain_one_near(std::span<const double> guess) const {
  const Impl& its = *impl_;
  const std::vector<int>& basis = its.span.basis();
  if (!its.span.has_basis() || basis.size() == its.edges.size()) return false;
  double largest = 0;
  for (const int e : its.edges) largest = std::max(largest, guess[static_cast<std::size_t>(e)]);
  const mpq_class near(tolerance::kRayEntry * largest);
  std::vector<mpq_class> x, low, high;
  for (const int e : its.edges) {
    x.emplace_back(guess[static_cast<std::size_t>(e)]);
    low.push_back(std::max(mpq_class(0), mpq_class(x.back() - near)));
    high.push_back(x.back() + near);
  }
  its.least_move->move(x);
  // What the free ones leave to the others.
  std::vector<mpq_class> right(its.span.row_number().size());
  for (std::size_t j = 0; j < its.edges.size(); ++j) {
    if (std::binary_search(basis.begin(), basis.end(), its.edges[j])) continue;
    if (x[j] <= low[j] || x[j] >= high[j]) return false;
    const IntegerColumn& column = *its.columns[j];
    const mpq_class strength = scaled(x[j], -column.shift);
    for (std::size_t k = 0; k < column.row.size(); ++k)
      right[static_cast<std::size_t>(column.row[k])] -= column.value[k] * strength;
  }
  const EdgeSpan::Combination others = its.span.combination(right);
  for (std::size_t c = 0, j = 0; c < basis.size(); ++c) {
    while (its.edges[j] != basis[c]) ++j;
    const IntegerColumn itself{{static_cast<int>(c)}, {1}, 0};
    if (others.x.compare(itself, low[j] * others.scale) <= 0) return false;
    if (others.x.compare(itself, high[j] * others.scale) >= 0) return false;
  }
  return its.span.holds(others, right);
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
