#include "libindet/polytope/sparse_decision.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "libindet/barrier/feasibility.h"
#include "libindet/barrier/verified_equations.h"
#include "libindet/barrier/verified_motion.h"
#include "libindet/base/tolerances.h"
#include "libindet/exact/certificate.h"
#include "libindet/exact/ray.h"
#include "libindet/nullspace/null_space.h"
#include "libindet/polytope/motion_rows.h"
#include "libindet/polytope/unbounded_polytope.h"

namespace indet {
namespace {

using barrier::BlockCholesky;
using barrier::BlockStructure;
using barrier::Boundedness;
using barrier::Feasibility;
using Proof = SparseDecision::Proof;

/// The rank of the equations, and whether some part of the load is outside their range.
struct Equations {
  std::vector<int> independent;
  bool ambiguous = false;
  Eigen::VectorXd unbalanced;  ///< v with Aᵀ v = 0, b·v < 0; empty if there is none
};

Equations examine(const EquilibriumProblem& problem) {
  Equations result;
  const Eigen::SparseMatrix<double>& A = problem.matrix;
  const Eigen::VectorXd b = problem.load();
  RankDecision rank = decide_rank(A);
  result.ambiguous = rank.ambiguous;
  result.independent = std::move(rank.independent_rows);
  if (!rank.qr) {
    if (b.size() > 0 && b.lpNorm<Eigen::Infinity>() > 0) result.unbalanced = -b;
    return result;
  }
  const SparseQr& qr = *rank.qr;
  if (static_cast<Eigen::Index>(result.independent.size()) == A.rows()) return result;
  Eigen::VectorXd u = qr.solve_transposed(b);
  u += qr.solve_transposed(b - A * u);
  Eigen::VectorXd left = b - A * u;
  for (const int row : result.independent) left[row] = 0;
  const double allowed = tolerance::kUnbalancedLoad * std::max(1.0, u.lpNorm<Eigen::Infinity>());
  if (left.lpNorm<Eigen::Infinity>() <= allowed) return result;
  // Dependent rows are combinations of the others, and these balance b: the difference of `left` and the
  // same combination of the others has no power along any unknown, and the power ‖left‖² along b.
  Eigen::VectorXd motion = left;
  for (int step = 0; step < 2; ++step) motion -= qr.solve(A.transpose() * motion);
  result.unbalanced = -motion;
  return result;
}

Eigen::VectorXd as_vector(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

/// What rational arithmetic proves, where it costs little.
class ExactProofs {
 public:
  ExactProofs(const Packing& packing, const EquilibriumProblem& natural, int most_rows)
      : packing_(packing), rows_(natural.equations()), most_rows_(most_rows) {}

  void add_step(const EquilibriumProblem& before, const SparseDecision::Step& step) {
    if (rows_ > most_rows_) {
      is_lost_ = true;
    } else {
      closings_.push_back({step.half_planes, motion_on_exact_rows(exact(), before, step.motion)});
    }
  }
  void prove_emptiness(SparseDecision& decision) {
    if (is_lost_ || rows_ > most_rows_) return;
    auto motion = exact::find_falling_motion(exact(), on_exact_rows(decision.problem, decision.motion),
                                             closings_, tolerance::kExactZero);
    if (!motion) return;
    decision.proof = Proof::kExact;
    decision.proven_motion = std::move(*motion);
  }
  std::vector<double> on_exact_rows(const EquilibriumProblem& problem, const Eigen::VectorXd& motion) {
    return motion_on_exact_rows(exact(), problem, motion);
  }
  /// The rank, and that the equations do not contradict each other.
  bool has_structure(const SparseDecision& decision) {
    return !is_lost_ && rows_ <= kModularRows * most_rows_ &&
           exact::proves_structure(exact(), closings_, static_cast<int>(decision.independent_rows.size()),
                                   static_cast<std::size_t>(most_rows_));
  }
  bool has_ray(const SparseDecision& decision) {
    if ((decision.ray.array() > 0).count() > most_rows_ || rows_ > kModularRows * most_rows_) return false;
    std::vector<double> strengths(static_cast<std::size_t>(exact().edges()), 0);
    for (int k = 0; k < decision.problem.unknowns(); ++k) {
      const Edge& edge = decision.problem.edge(k);
      const double scale = (edge.is_slack() ? 1 : edge.R) / decision.ray.maxCoeff();
      strengths[static_cast<std::size_t>(decision.problem.half_plane(edge))] = decision.ray[k] * scale;
    }
    return exact::proves_ray(exact(), strengths, 0);
  }

 private:
  /// Modulo a prime a sparse factorisation costs as much less than rational numbers do.
  static constexpr int kModularRows = 250;

  const exact::ContactProblem& exact() {
    if (!exact_) exact_.emplace(packing_);
    return *exact_;
  }

  const Packing& packing_;
  int rows_, most_rows_;
  bool is_lost_ = false;  ///< some closed edges are not proven
  std::optional<exact::ContactProblem> exact_;
  std::vector<exact::Closing> closings_;
};

void close_edges(const Feasibility& feasibility, const BlockStructure& structure, ExactProofs& exact,
                 SparseDecision& decision) {
  EquilibriumProblem& problem = decision.problem;
  std::vector<ContactMode> modes = problem.modes;
  std::vector<int> closed_bounds;
  SparseDecision::Step step{{}, problem.rows, on_equations(problem, structure, feasibility.y)};
  for (const int k : feasibility.closed) {
    const Edge& edge = problem.edge(k);
    step.half_planes.push_back(problem.half_plane(edge));
    if (edge.is_slack()) {
      closed_bounds.push_back(edge.bound);
      continue;
    }
    ContactMode& mode = modes[static_cast<std::size_t>(edge.contact.value())];
    mode = without_edge(mode, edge.sign);
  }
  exact.add_step(problem, step);
  decision.steps.push_back(std::move(step));
  problem = restrict_modes(problem, modes, closed_bounds);
}

/// That x > 0 is near a state, that the rank is right, and what follows from y or the ray.
void prove_states(const BlockStructure& structure, BlockCholesky& cholesky, const std::vector<double>& x,
                  const std::vector<double>& y, ExactProofs& exact, SparseDecision& decision) {
  // The centre is the best point to prove it from, where there is one.
  barrier::AnalyticCentre point;
  if (decision.status != PolytopeStatus::kUnbounded)
    point = barrier::find_analytic_centre(structure, cholesky);
  if (!point.found) {
    point.x = x;
    point.y = y;
    point.y.resize(static_cast<std::size_t>(structure.rows()), 0.0);
  }
  const barrier::VerifiedEquations equations(decision.problem, structure, point);
  if (!(equations.smallest_singular_value() > 0)) return;
  if (decision.status == PolytopeStatus::kBounded && !equations.is_proven()) return;
  // Rows that follow from others, and closed edges, are more than a bound of rounding can tell.
  const bool is_plain = structure.rows() == decision.problem.equations() && decision.steps.empty();
  if (!is_plain && !exact.has_structure(decision)) return;
  const bool has_ray = decision.status == PolytopeStatus::kUnbounded;
  if (has_ray)
    decision.unbounded =
        find_unbounded_polytope(decision.problem, decision.independent_rows, x, decision.ray);
  const bool is_exact = has_ray && !decision.unbounded;
  if (is_exact && !exact.has_ray(decision)) return;
  decision.proof = is_plain && !is_exact ? Proof::kFloating : Proof::kExact;
}

}  // namespace

SparseDecision decide_sparsely(const Packing& packing, int exact_rows) {
  SparseDecision decision;
  decision.problem = pose_equilibrium(packing);
  decision.margin = std::numeric_limits<double>::infinity();
  EquilibriumProblem& problem = decision.problem;
  ExactProofs exact(packing, problem, exact_rows);
  for (;;) {
    Equations equations = examine(problem);
    decision.rank_ambiguous = decision.rank_ambiguous || equations.ambiguous;
    decision.independent_rows = std::move(equations.independent);
    const auto set_empty = [&](const Eigen::VectorXd& motion) {
      decision.decided = true;
      decision.motion = motion / motion.lpNorm<Eigen::Infinity>();
    };
    if (equations.unbalanced.size() > 0) {
      set_empty(equations.unbalanced);
      exact.prove_emptiness(decision);
      return decision;
    }
    const BlockStructure structure(problem, decision.independent_rows);
    BlockCholesky cholesky(structure);
    const Feasibility feasibility = barrier::find_feasibility(structure, cholesky);
    decision.iterations += feasibility.iterations;
    decision.margin = std::min(decision.margin, feasibility.margin);
    switch (feasibility.kind) {
      case Feasibility::Kind::kUndecided:
        return decision;
      case Feasibility::Kind::kEmpty: {
        set_empty(on_equations(problem, structure, feasibility.y));
        const Boundedness boundedness = barrier::find_boundedness(structure, cholesky);
        if (decision.steps.empty() && boundedness.bounded) {
          if (const auto y = barrier::proven_motion(problem, structure, feasibility.y, boundedness.y)) {
            decision.proof = Proof::kFloating;
            decision.proven_motion = exact.on_exact_rows(problem, on_equations(problem, structure, *y));
          }
        }
        if (decision.proof == Proof::kNone) exact.prove_emptiness(decision);
        return decision;
      }
      case Feasibility::Kind::kClosed:
        close_edges(feasibility, structure, exact, decision);
        continue;
      case Feasibility::Kind::kInterior:
        break;
    }
    decision.interior = as_vector(feasibility.x);
    // Rows that follow from the others have not been looked at.
    const double residual =
        (problem.edge_matrix * decision.interior - problem.load()).lpNorm<Eigen::Infinity>();
    if (residual > tolerance::kImplicitEquality * std::max(1.0, decision.interior.lpNorm<Eigen::Infinity>()))
      return decision;
    decision.dim = problem.unknowns() - structure.rows();
    Boundedness boundedness;
    decision.status = PolytopeStatus::kPoint;
    decision.decided = true;
    if (decision.dim > 0) {
      boundedness = barrier::find_boundedness(structure, cholesky);
      decision.iterations += boundedness.iterations;
      decision.margin = std::min(decision.margin, boundedness.margin);
      decision.decided = boundedness.decided;
      decision.status = boundedness.bounded ? PolytopeStatus::kBounded : PolytopeStatus::kUnbounded;
      if (boundedness.bounded) decision.bounding = on_equations(problem, structure, boundedness.y);
      decision.ray = as_vector(boundedness.ray);
    }
    if (decision.decided) prove_states(structure, cholesky, feasibility.x, boundedness.y, exact, decision);
    return decision;
  }
}

}  // namespace indet
