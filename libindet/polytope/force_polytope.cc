#include "libindet/polytope/force_polytope.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "libindet/barrier/feasibility.h"
#include "libindet/base/error.h"
#include "libindet/base/tolerances.h"
#include "libindet/exact/certificate.h"
#include "libindet/lp/independent_equations.h"
#include "libindet/lp/purification.h"
#include "libindet/lp/vertex.h"
#include "libindet/polytope/blocks.h"
#include "libindet/polytope/interior.h"
#include "libindet/polytope/motion_rows.h"
#include "libindet/polytope/recession_cone.h"

namespace indet {
namespace {

SlopeView slope_view(const EquilibriumProblem& problem, const NullSpace& null_space) {
  SlopeView view;
  view.slope = problem.to_edges * null_space.basis;
  view.offset = problem.to_edges * null_space.particular;
  if (null_space.rank > 0 && view.dim() >= kFewestForEquations) {
    view.set = std::make_shared<const FeasibleSet>(
        independent_equations(problem.edge_matrix, null_space.independent_rows, view.offset));
  }
  return view;
}

/// True if the sign of t, or that it is zero, could be the work of rounding.
bool is_doubtful(const InteriorPoint& interior, bool is_zero, double scale) {
  if (is_zero) return std::max(std::abs(interior.slack), interior.infeasibility) > tolerance::kNoise * scale;
  return interior.infeasibility > 0.5 * std::abs(interior.slack);
}

/// Notes a decision that a change of the packing's numbers by this share of them may alter, if it is one.
void doubt(bool is_one, double change, ForcePolytope& polytope) {
  if (!is_one) return;
  polytope.doubtful = true;
  polytope.hairline = std::fmax(polytope.hairline, std::fmax(change, std::numeric_limits<double>::epsilon()));
}

/// A full-dimensional set with a point in its interior.
struct InteriorSet {
  SlopeView view;
  Eigen::VectorXd z;
};

/// Poses the problem again with ever more edges closed, until F is empty (returns nothing) or
/// full-dimensional in what is left.
std::optional<InteriorSet> reduce_to_full_dimension(const Packing& packing, const LpOptions& options,
                                                    ForcePolytope& polytope) {
  const exact::ContactProblem& exact = *polytope.exact;
  std::vector<exact::Closing> closings;
  for (;;) {
    EquilibriumProblem& problem = polytope.problem;
    const NullSpace& null_space = *polytope.null_space;
    polytope.rank_ambiguous = polytope.rank_ambiguous || null_space.ambiguous;
    doubt(null_space.ambiguous, null_space.largest_rejected, polytope);
    const auto prove_emptiness = [&](const Eigen::VectorXd& motion) {
      const std::vector<double> guess = motion_on_exact_rows(exact, problem, motion);
      const auto proven = exact::find_falling_motion(exact, guess, closings, tolerance::kExactZero);
      set_motion(packing, exact, proven.value_or(guess), polytope);
      doubt(!proven, std::abs(polytope.interior_slack), polytope);
    };
    if (null_space.unbalanced.size() > 0) {
      prove_emptiness(null_space.unbalanced);
      return {};
    }
    SlopeView view = slope_view(problem, null_space);
    const InteriorPoint interior = find_interior_point(view, options);
    polytope.pivots += interior.pivots;
    ++polytope.solves;
    polytope.interior_slack = interior.slack;
    const double largest =
        null_space.particular.size() > 0 ? null_space.particular.lpNorm<Eigen::Infinity>() : 0.0;
    const double scale = std::max(1.0, largest);
    const bool is_zero = std::abs(interior.slack) <= tolerance::kImplicitEquality * scale;
    doubt(is_doubtful(interior, is_zero, scale),
          std::max(std::abs(interior.slack), interior.infeasibility) / scale, polytope);
    if (!is_zero && interior.slack > 0) {
      doubt(!exact::proves_structure(exact, closings, null_space.rank), null_space.largest_rejected,
            polytope);
      polytope.interior = view.offset + view.slope * interior.z;
      return InteriorSet{view, interior.z};
    }
    const Eigen::VectorXd velocities = problem.to_edges.transpose() * interior.multipliers;
    Eigen::VectorXd motion = motion_from_contacts(null_space, problem.equations(), velocities);
    if (!is_zero) {
      if (motion.dot(problem.load()) > 0) motion = -motion;
      prove_emptiness(motion);
      return {};
    }
    std::vector<ContactMode> modes = problem.modes;
    std::vector<int> closed_bounds;
    exact::Closing closing{{}, motion_on_exact_rows(exact, problem, motion)};
    const double significant = interior.multipliers.maxCoeff() * tolerance::kClosingMultiplier;
    for (int k = 0; k < view.inequalities(); ++k) {
      if (interior.multipliers[k] <= significant) continue;
      const Edge& edge = problem.edges[static_cast<std::size_t>(k)];
      closing.edges.push_back(problem.half_plane(edge));
      if (edge.is_slack()) {
        closed_bounds.push_back(edge.bound);
        continue;
      }
      ContactMode& mode = modes[static_cast<std::size_t>(edge.contact.value())];
      mode = without_edge(mode, edge.sign);
    }
    if (closing.edges.empty() && !problem.bounds.empty()) {
      throw InputError(
          "rounding decides whether forces within these bounds balance: some are too narrow, or too far "
          "away. "
          "Leave bounds that set no limit empty, and set lo = hi where a force is known exactly");
    }
    if (closing.edges.empty())
      throw LibraryError("rounding decides whether forces balance, and no decision could be found");
    closings.push_back(std::move(closing));
    problem = restrict_modes(problem, modes, closed_bounds);
    polytope.null_space = std::make_shared<NullSpace>(compute_null_space(problem.matrix, problem.load()));
  }
}

Vertex find_lightest_vertex(const EquilibriumProblem& problem, const InteriorSet& interior,
                            const LpOptions& options, ForcePolytope& polytope) {
  const SlopeView& view = interior.view;
  std::vector<std::pair<int, double>> normal_forces;
  for (int k = 0; k < view.inequalities(); ++k)
    normal_forces.emplace_back(k, -problem.edges[static_cast<std::size_t>(k)].R);
  LpSolver solver(view, choose_formulation_of_one(view), options);
  const Objective lightness = make_objective(view, normal_forces);
  const LpAnswer answer = solver.maximise(lightness, purify_to_vertex(view, interior.z, lightness.along_z));
  polytope.pivots += answer.pivots;
  ++polytope.solves;
  if (answer.status != LpStatus::kOptimal)
    throw LibraryError("no vertex of the force polytope could be found");
  return compute_vertex(view, answer.basis);
}

/// A ray of maximal support, as the barrier method finds it; the one that is known where it does not.
Eigen::VectorXd widest_ray(const ForcePolytope& polytope) {
  const barrier::BlockStructure structure(polytope.problem, polytope.null_space->independent_rows);
  barrier::BlockCholesky cholesky(structure);
  const barrier::Boundedness found = barrier::find_boundedness(structure, cholesky);
  if (!found.decided || found.bounded) return polytope.ray;
  return Eigen::Map<const Eigen::VectorXd>(found.ray.data(), std::ssize(found.ray));
}

void find_recession_cones(const LpOptions& options, ForcePolytope& polytope) {
  const bool is_large = std::any_of(polytope.blocks.begin(), polytope.blocks.end(), [](const auto& block) {
    return block.view.dim() >= kFewestForEquations;
  });
  const Eigen::VectorXd guess = is_large ? widest_ray(polytope) : polytope.ray;
  for (PolytopeBlock& block : polytope.blocks) {
    if (polytope.blocks.size() == 1 || find_recession_ray(block.view, options).x.size() > 0)
      block.recession = find_recession_cone(block.view, guess(block.edges), options);
  }
}

}  // namespace

const char* to_string(PolytopeStatus status) {
  switch (status) {
    case PolytopeStatus::kBounded:
      return "bounded";
    case PolytopeStatus::kUnbounded:
      return "unbounded";
    case PolytopeStatus::kPoint:
      return "point";
    case PolytopeStatus::kEmpty:
      return "empty";
  }
  return "?";
}

ForcePolytope find_force_polytope(const Packing& packing, const LpOptions& options) {
  ForcePolytope polytope;
  polytope.natural = pose_equilibrium(packing);
  polytope.problem = polytope.natural;
  polytope.natural_null_space =
      std::make_shared<NullSpace>(compute_null_space(polytope.natural.matrix, polytope.natural.load()));
  polytope.null_space = polytope.natural_null_space;
  polytope.exact = std::make_shared<exact::ContactProblem>(packing);
  const std::optional<InteriorSet> interior = reduce_to_full_dimension(packing, options, polytope);
  if (!interior) return polytope;

  const SlopeView& view = interior->view;
  polytope.dim = view.dim();
  if (polytope.dim == 0) {
    polytope.status = PolytopeStatus::kPoint;
    polytope.lightest = view.offset;
    polytope.bounding_multipliers.setZero(view.inequalities());
    return polytope;
  }
  RecessionRay ray = find_recession_ray(view, options);
  polytope.pivots += ray.pivots;
  ++polytope.solves;
  doubt(ray.infeasibility > ray.noise, ray.infeasibility, polytope);
  polytope.ray = std::move(ray.x);
  polytope.bounding_multipliers = std::move(ray.multipliers);
  polytope.status = polytope.ray.size() > 0 ? PolytopeStatus::kUnbounded : PolytopeStatus::kBounded;
  const Vertex lightest = find_lightest_vertex(polytope.problem, *interior, options, polytope);
  polytope.lightest = lightest.x;
  polytope.blocks = split_into_blocks(polytope.problem, view, lightest);
  if (polytope.status == PolytopeStatus::kUnbounded) find_recession_cones(options, polytope);
  return polytope;
}

}  // namespace indet
