#include "libindet/range/doubled_equations.h"

#include <algorithm>
#include <cmath>

#include "libindet/exact/contact_problem.h"
#include "libindet/polytope/motion_rows.h"

namespace indet {
namespace {

/// Within 4 u² of the number, relative to it, but for underflow.
Doubled nearest(const mpq_class& value) {
  const double high = value.get_d();  // towards 0
  if (!std::isfinite(high)) return {high, 0};
  return Doubled::of(high, mpq_class(value - mpq_class(high)).get_d());
}

/// The rows of the exact problem in those of the problem: the row of a bound after that of the same force's
/// lo is the difference of both (bound_rows.h).
class RowMap {
 public:
  struct Target {
    int row = 0;
    mpq_class scale;
  };
  explicit RowMap(const EquilibriumProblem& problem, const exact::ContactProblem& exact)
      : targets_(static_cast<std::size_t>(exact.rows())) {
    for (int i = 0; i < problem.equations(); ++i) {
      const EquilibriumRow& row = problem.rows[static_cast<std::size_t>(i)];
      if (row.bound >= 0) {
        add(exact.row_of_bound(row.bound), i, 1);
        if (problem.bounds[static_cast<std::size_t>(row.bound)].follows_lower())
          add(exact.row_of_bound(row.bound - 1), i, -1);
        continue;
      }
      const int number = exact.row(row.body, row.component);
      if (number < 0) continue;  // 0 = 0
      add(number, i, exact_row_scale(exact, row));
    }
  }
  const std::vector<Target>& operator[](int row) const { return targets_[static_cast<std::size_t>(row)]; }

 private:
  void add(int exact_row, int row, double scale) {
    targets_[static_cast<std::size_t>(exact_row)].push_back({row, mpq_class(scale)});
  }
  std::vector<std::vector<Target>> targets_;
};

/// Sums of what several rows of the exact problem add to one of the problem, in the order of rows.
void collect(std::vector<std::pair<int, mpq_class>>& entries) {
  std::stable_sort(entries.begin(), entries.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (std::size_t k = 1; k < entries.size(); ++k) {
    if (entries[k].first != entries[k - 1].first) continue;
    entries[k].second += entries[k - 1].second;
    entries[k - 1].second = 0;
  }
  std::erase_if(entries, [](const auto& entry) { return entry.second == 0; });
}

}  // namespace

DoubledEquations::DoubledEquations(const ForcePolytope& polytope) {
  const EquilibriumProblem& problem = polytope.problem;
  const exact::ContactProblem& exact = *polytope.exact;
  const RowMap map(problem, exact);
  first_.push_back(0);
  for (int k = 0; k < problem.unknowns(); ++k) {
    const Edge& edge = problem.edge(k);
    const mpq_class scale(edge.is_slack() ? 1 : edge.R);
    const exact::IntegerColumn& column = exact.edge(problem.half_plane(edge));
    std::vector<std::pair<int, mpq_class>> entries;
    for (std::size_t e = 0; e < column.row.size(); ++e) {
      const mpq_class value = scale * exact::scaled(mpq_class(column.value[e]), -column.shift);
      for (const RowMap::Target& target : map[column.row[e]])
        entries.emplace_back(target.row, value * target.scale);
    }
    collect(entries);
    for (const auto& [row, value] : entries) entries_.push_back({row, nearest(value)});
    first_.push_back(static_cast<int>(entries_.size()));
  }
  std::vector<mpq_class> load(static_cast<std::size_t>(problem.equations()));
  const mpq_class unit = mpq_class(exact.load_scale()) * mpq_class(problem.units.internal_in_scene());
  for (int row = 0; row < exact.rows(); ++row) {
    const mpz_class& value = exact.load()[static_cast<std::size_t>(row)];
    if (value == 0) continue;
    for (const RowMap::Target& target : map[row])
      load[static_cast<std::size_t>(target.row)] += mpq_class(value) / unit * target.scale;
  }
  for (const mpq_class& value : load) load_.push_back(nearest(value));
}

Bounded DoubledEquations::residual(std::span<const Doubled> x) const {
  std::vector<DoubledSum> sums(load_.size());
  for (std::size_t i = 0; i < load_.size(); ++i) sums[i].add(load_[i]);
  for (int k = 0; k < columns(); ++k) {
    const Doubled& strength = x[static_cast<std::size_t>(k)];
    if (strength.is_zero()) continue;
    const Doubled less{-strength.high, -strength.low};
    for (const Entry& entry : column(k))
      sums[static_cast<std::size_t>(entry.row)].add_product(entry.value, less);
  }
  Bounded result{Eigen::VectorXd(rows()), Eigen::VectorXd(rows())};
  for (int i = 0; i < rows(); ++i) {
    result.value[i] = sums[static_cast<std::size_t>(i)].value();
    result.error[i] = sums[static_cast<std::size_t>(i)].error();
  }
  return result;
}

Bounded DoubledEquations::reduced_costs(const DoubledFunctional& g, std::span<const Doubled> y) const {
  Bounded result{Eigen::VectorXd(columns()), Eigen::VectorXd(columns())};
  std::size_t next = 0;
  for (int k = 0; k < columns(); ++k) {
    DoubledSum sum;
    if (next < g.size() && g[next].first == k) sum.add(g[next++].second);
    for (const Entry& entry : column(k)) {
      const Doubled& motion = y[static_cast<std::size_t>(entry.row)];
      if (!motion.is_zero()) sum.add_product(entry.value, {-motion.high, -motion.low});
    }
    result.value[k] = sum.value();
    result.error[k] = sum.is_zero() ? 0 : sum.error();
  }
  return result;
}

BoundedNumber DoubledEquations::load_product(std::span<const Doubled> y) const {
  DoubledSum sum;
  for (std::size_t i = 0; i < load_.size(); ++i) sum.add_product(load_[i], y[i]);
  return {sum.doubled(), sum.error()};
}

BoundedNumber DoubledEquations::value(const DoubledFunctional& g, std::span<const Doubled> x) {
  DoubledSum sum;
  for (const auto& [k, coefficient] : g) sum.add_product(coefficient, x[static_cast<std::size_t>(k)]);
  return {sum.doubled(), sum.error()};
}

}  // namespace indet
