#include "libindet/range/solution_bounds.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "libindet/base/constants.h"
#include "libindet/base/rounding_bounds.h"
#include "libindet/lp/vertex.h"
#include "libindet/polytope/central_polytope.h"
#include "libindet/polytope/interior.h"

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

/// How far x_k moves where no unknown moves further than 1.
Eigen::VectorXd reach_of_unknowns(const EquilibriumProblem& problem) {
  Eigen::VectorXd reach = Eigen::VectorXd::Ones(problem.unknowns());
  for (int k = 0; k < problem.unknowns(); ++k) {
    const Edge& edge = problem.edge(k);
    if (problem.is_stick(edge)) reach[k] = kWiden * 0.5 * (1 / edge.R + 1 / std::abs(edge.T));
  }
  return reach;
}

}  // namespace

SolutionBounds::SolutionBounds(const ForcePolytope& polytope, const DoubledEquations& equations,
                               const LightestSystem& lightest, const BasisSystem& everywhere,
                               const UnlimitedEdges& unlimited)
    : polytope_(polytope), problem_(polytope.problem), equations_(equations) {
  if (polytope.central) {
    take_centre();
    return;
  }
  bound_right_inverse();
  reach_ = reach_of_unknowns(problem_);
  interior_ = polytope.interior;
  std::vector<Doubled> x(static_cast<std::size_t>(interior_.size()));
  for (std::size_t k = 0; k < x.size(); ++k) x[k].high = interior_[static_cast<Eigen::Index>(k)];
  interior_shift_ = shift(equations.residual(x));
  margin_ = interior_ - kWiden * interior_shift_ * reach_;
  has_interior_ = std::isfinite(interior_shift_) && (margin_.array() > 0).all();
  bound_strengths(everywhere);
  if (unlimited.any()) bound_limited_strengths(lightest, unlimited);
}

void SolutionBounds::take_centre() {
  const CentralPolytope& central = *polytope_.central;
  const std::vector<double>& x = central.centre.x;
  reach_ = interior_ = Eigen::Map<const Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
  interior_shift_ = central.equations->centre_shift();
  margin_ = interior_ * ((1 - interior_shift_) / kWiden);
  has_interior_ = true;
  const std::vector<double>& X = central.equations->strength_bounds();
  strength_ = kWiden * Eigen::Map<const Eigen::VectorXd>(X.data(), static_cast<Eigen::Index>(X.size()));
}

double SolutionBounds::shift(const Bounded& residual) const {
  const Eigen::VectorXd bound = kWiden * (residual.value.cwiseAbs() + residual.error);
  double shift = 0;
  if (polytope_.central) {
    std::vector<double> in_places;
    for (const int row : polytope_.central->structure.equation_of_place()) in_places.push_back(bound[row]);
    shift = kWiden * polytope_.central->equations->shift_of_residual(in_places);
  } else {
    for (const int row : polytope_.null_space->independent_rows)
      shift = std::max(shift, kWiden * gain_ * bound[row]);
  }
  return std::isfinite(bound.sum()) && !std::isnan(shift) ? shift : kInfinity;
}

void SolutionBounds::bound_right_inverse() {
  const std::vector<int>& rows = polytope_.null_space->independent_rows;
  const auto rank = static_cast<Eigen::Index>(rows.size());
  if (rank == 0) {
    gain_ = 0;
    return;
  }
  if (rank != problem_.unknowns() - polytope_.dim) return;
  const Eigen::MatrixXd inverse = right_inverse(*polytope_.null_space, problem_.matrix);
  const Eigen::VectorXd sums = inverse.cwiseAbs().rowwise().sum();
  const double norm = kWiden * sums.maxCoeff();
  const Eigen::MatrixXd product = (problem_.matrix * inverse)(rows, Eigen::all);
  const Eigen::VectorXd off = (product - Eigen::MatrixXd::Identity(rank, rank)).cwiseAbs().rowwise().sum();
  const double longest = static_cast<double>(problem_.unknowns() + 2);
  const Eigen::VectorXd magnitude = problem_.matrix.cwiseAbs() * sums;
  const Eigen::VectorXd rounding = kRoundoff * (longest * magnitude + 8 * inexact_entries(sums));
  const double gamma = kWiden * (off + rounding(rows)).maxCoeff();
  if (gamma < 0.5 && std::isfinite(norm)) gain_ = kWiden * norm / (1 - gamma);
}

/// Σ of `weight` over the entries of each row that are not stored doubles themselves, in units of 8u: entries
/// of stress are f·l/L, with |f| ≤ √2 and |l|/L ≤ 3/2, each rounded several times.
Eigen::VectorXd SolutionBounds::inexact_entries(const Eigen::VectorXd& weight) const {
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(problem_.equations());
  for (int j = 0; j < problem_.matrix.outerSize(); ++j) {
    const bool stored = has_stored_entries(problem_, problem_.edge(j));
    for (Eigen::SparseMatrix<double>::InnerIterator it(problem_.matrix, j); it; ++it) {
      const bool is_stress = problem_.rows[static_cast<std::size_t>(it.row())].body.is_cell();
      if (!stored || is_stress) sums[it.row()] += (is_stress ? 3 : 1) * weight[j];
    }
  }
  return sums;
}

void SolutionBounds::bound_strengths(const BasisSystem& everywhere) {
  strength_.setConstant(problem_.unknowns(), kInfinity);
  if (polytope_.bounding_multipliers.size() == 0 || problem_.unknowns() == 0) return;
  DoubledFunctional sum, with_multipliers;
  for (int k = 0; k < problem_.unknowns(); ++k) {
    sum.push_back({k, {1, 0}});
    with_multipliers.push_back({k, {1 + polytope_.bounding_multipliers[k], 0}});
  }
  const std::vector<Doubled> y = everywhere.multipliers(with_multipliers).value;
  const Bounded excess = equations_.reduced_costs(sum, y);
  const double share = std::max(0.0, kWiden * (excess.value + excess.error).maxCoeff());
  if (!(share < 0.5)) return;
  const BoundedNumber load = equations_.load_product(y);
  strength_.setConstant(kWiden * std::max(0.0, load.value.rounded() + load.error) / (1 - kWiden * share));
}

void SolutionBounds::bound_limited_strengths(const LightestSystem& lightest,
                                             const UnlimitedEdges& unlimited) {
  std::vector<std::pair<std::size_t, Vertex>> found;
  DoubledFunctional sum;
  for (std::size_t b = 0; b < polytope_.blocks.size(); ++b) {
    const PolytopeBlock& block = polytope_.blocks[b];
    std::vector<std::pair<int, double>> limited;
    for (std::size_t k = 0; k < block.edges.size(); ++k) {
      if (unlimited.contains(block.edges[k])) continue;
      limited.emplace_back(static_cast<int>(k), 1.0);
      sum.push_back({block.edges[k], {1, 0}});
    }
    const LpAnswer answer =
        maximise_robustly(block.view, make_objective(block.view, std::move(limited)), block.lightest, {});
    if (answer.status != LpStatus::kOptimal) return;
    found.emplace_back(b, locate_vertex(block.view, answer.basis));
  }
  std::sort(sum.begin(), sum.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  BasisSystem::Vertices vertices;
  for (const auto& [block, vertex] : found) vertices.emplace_back(block, &vertex);
  const BasisSystem::Solution y = BasisSystem(polytope_, equations_, lightest, vertices).multipliers(sum);
  const double shift = unlimited.shift(y.residual);
  double share = 0;
  for (int k = 0; k < problem_.unknowns(); ++k) {
    if (unlimited.contains(k)) continue;
    share =
        std::fmax(share, kWiden * (y.residual.value[k] + y.residual.error[k] + shift * unlimited.reach()[k]));
  }
  if (!(share < 0.5)) return;
  const BoundedNumber load = equations_.load_product(y.value);
  const double bound = std::fmax(0, load.value.rounded() + load.error + shift * unlimited.load_reach());
  for (int k = 0; k < problem_.unknowns(); ++k) {
    if (!unlimited.contains(k)) strength_[k] = kWiden * bound / (1 - kWiden * share);
  }
}

}  // namespace indet
