#include "libindet/range/basis_system.h"

#include <span>
#include <utility>

namespace indet {
namespace {

/// Pivots near those of partial pivoting.
constexpr double kLeastShare = 0.1;
/// A residual, relative to the first, that adds nothing to the last digit of a double.
constexpr double kSmallResidual = 0x1p-85;
constexpr int kMostSteps = 12;

std::span<double> span_of(Eigen::VectorXd& v) { return {v.data(), static_cast<std::size_t>(v.size())}; }

/// The edges at 0 where some blocks are at a basis, and the others at their lightest one.
std::vector<bool> active_edges(const ForcePolytope& polytope, const BasisSystem::Vertices& vertices) {
  std::vector<bool> active(static_cast<std::size_t>(polytope.problem.unknowns()), false);
  std::vector<const Basis*> bases;
  for (const PolytopeBlock& block : polytope.blocks) bases.push_back(&block.lightest);
  for (const auto& [block, vertex] : vertices) bases[block] = &vertex->basis;
  for (std::size_t b = 0; b < bases.size(); ++b) {
    for (const int k : *bases[b])
      active[static_cast<std::size_t>(polytope.blocks[b].edges[static_cast<std::size_t>(k)])] = true;
  }
  return active;
}

/// Refines a solution until what `residual` leaves in `asked`, the equations that it solves, is small, or a
/// step does not make it much smaller. `correction`: for what is left in all of them.
template <class Residual, class Asked, class Correction>
BasisSystem::Solution refine(std::size_t size, Residual residual, Asked asked, Correction correction) {
  BasisSystem::Solution best{std::vector<Doubled>(size), {}};
  best.residual = residual(best.value);
  Eigen::VectorXd left = asked(best.residual.value);
  const double enough = kSmallResidual * left.lpNorm<Eigen::Infinity>();
  for (int step = 0; step < kMostSteps; ++step) {
    const double largest = left.lpNorm<Eigen::Infinity>();
    if (!(largest > enough)) break;
    BasisSystem::Solution next{best.value, {}};
    const Eigen::VectorXd more = correction(left);
    for (std::size_t i = 0; i < size; ++i) {
      const double term = more[static_cast<Eigen::Index>(i)];
      if (term != 0) next.value[i] = sum(next.value[i], term);
    }
    next.residual = residual(next.value);
    left = asked(next.residual.value);
    if (!(left.lpNorm<Eigen::Infinity>() < largest)) break;
    best = std::move(next);
  }
  return best;
}

}  // namespace

LightestSystem::LightestSystem(const ForcePolytope& polytope, const DoubledEquations& equations)
    : equations_(equations.rows()),
      edges_(equations.columns()),
      rows_(polytope.null_space->independent_rows),
      lu_(kLeastShare, 0) {
  const std::vector<bool> active = active_edges(polytope, {});
  std::vector<int> number(static_cast<std::size_t>(equations.rows()), -1);
  for (std::size_t i = 0; i < rows_.size(); ++i)
    number[static_cast<std::size_t>(rows_[i])] = static_cast<int>(i);
  std::vector<int> first{0}, rows;
  std::vector<double> entries;
  for (int k = 0; k < equations.columns(); ++k) {
    if (active[static_cast<std::size_t>(k)]) continue;
    basic_.push_back(k);
    for (const DoubledEquations::Entry& entry : equations.column(k)) {
      const int row = number[static_cast<std::size_t>(entry.row)];
      if (row < 0) continue;
      rows.push_back(row);
      entries.push_back(entry.value.high);
    }
    first.push_back(static_cast<int>(rows.size()));
  }
  is_regular_ = basic_.size() == rows_.size() && (rows_.empty() || !lu_.factor(first, rows, entries));
}

Eigen::VectorXd LightestSystem::solution(const Eigen::VectorXd& r) const {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(edges_);
  if (rows_.empty() || !is_regular_) return x;
  Eigen::VectorXd right = r(rows_);
  lu_.solve(span_of(right));
  x(basic_) = right;
  return x;
}

Eigen::VectorXd LightestSystem::motion(const Eigen::VectorXd& c) const {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(equations_);
  if (rows_.empty() || !is_regular_) return y;
  Eigen::VectorXd right = c(basic_);
  lu_.solve_transposed(span_of(right));
  y(rows_) = right;
  return y;
}

BasisSystem::BasisSystem(const ForcePolytope& polytope, const DoubledEquations& equations,
                         const LightestSystem& lightest, Vertices vertices)
    : polytope_(polytope),
      equations_(equations),
      lightest_(lightest),
      vertices_(std::move(vertices)),
      active_(active_edges(polytope, vertices_)) {}

BasisSystem::Solution BasisSystem::state() const {
  return refine(
      active_.size(), [&](const std::vector<Doubled>& x) { return equations_.residual(x); },
      [&](const Eigen::VectorXd& left) -> Eigen::VectorXd {
        Eigen::VectorXd asked = Eigen::VectorXd::Zero(left.size());
        const std::vector<int>& rows = polytope_.null_space->independent_rows;
        asked(rows) = left(rows);
        return asked;
      },
      [&](const Eigen::VectorXd& r) { return solution(r); });
}

BasisSystem::Solution BasisSystem::multipliers(const DoubledFunctional& g) const {
  return refine(
      static_cast<std::size_t>(equations_.rows()),
      [&](const std::vector<Doubled>& y) { return equations_.reduced_costs(g, y); },
      [&](Eigen::VectorXd left) {
        for (std::size_t k = 0; k < active_.size(); ++k) {
          if (active_[k]) left[static_cast<Eigen::Index>(k)] = 0;
        }
        return left;
      },
      [&](const Eigen::VectorXd& c) { return motion(c); });
}

/// x with x_N = 0 and A x = r.
Eigen::VectorXd BasisSystem::solution(const Eigen::VectorXd& r) const {
  Eigen::VectorXd x = lightest_.solution(r);
  for (const auto& [number, vertex] : vertices_) {
    const PolytopeBlock& block = polytope_.blocks[number];
    const Eigen::VectorXd own = x(block.edges);
    x(block.edges) = own - vertex->direction(block.view, own(vertex->basis));
  }
  for (std::size_t k = 0; k < active_.size(); ++k) {
    if (active_[k]) x[static_cast<Eigen::Index>(k)] = 0;
  }
  return x;
}

/// y with (Aᵀ y)_B = c_B. Precondition: c_N = 0.
Eigen::VectorXd BasisSystem::motion(Eigen::VectorXd c) const {
  for (const auto& [number, vertex] : vertices_) {
    const PolytopeBlock& block = polytope_.blocks[number];
    const Eigen::VectorXd costs = vertex->multipliers(block.view, c(block.edges));
    for (Eigen::Index k = 0; k < costs.size(); ++k)
      c[block.edges[static_cast<std::size_t>(vertex->basis[static_cast<std::size_t>(k)])]] += costs[k];
  }
  return lightest_.motion(c);
}

}  // namespace indet
