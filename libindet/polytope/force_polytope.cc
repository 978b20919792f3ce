#include "indet/polytope/force_polytope.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "indet/base/error.h"
#include "indet/base/tolerances.h"
#include "indet/lp/vertex.h"
#include "indet/lp/walk.h"
#include "indet/polytope/blocks.h"
#include "indet/polytope/interior.h"

namespace indet {
namespace {

/// Spreads a motion of the equations' rows over the disks; largest entry 1.
void set_motion(const Packing& packing, const ContactMatrix& contacts, const Eigen::VectorXd& rows,
                ForcePolytope& polytope) {
  polytope.motion.setZero(packing.disk_count(), 3);
  const double largest = rows.lpNorm<Eigen::Infinity>();
  for (Eigen::Index i = 0; i < rows.size(); ++i) {
    const EquilibriumRow& row = contacts.rows[static_cast<std::size_t>(i)];
    // Entries at the level of rounding say nothing about which disk moves.
    const double velocity = rows[i] / largest;
    polytope.motion(row.disk.value(), row.component) =
        std::abs(velocity) > tolerance::kReducedCost ? velocity : 0;
  }
}

/// What is left of a contact when the edge of the given sign is closed.
ContactMode close_edge(ContactMode mode, int sign) {
  if (mode != ContactMode::kStick) return ContactMode::kOpen;
  return sign > 0 ? ContactMode::kSlideMinus : ContactMode::kSlidePlus;
}

FeasibleSet feasible_set(const ContactMatrix& contacts, const NullSpace& null_space) {
  FeasibleSet set;
  set.slope = contacts.to_edges * null_space.basis;
  set.offset = contacts.to_edges * null_space.particular;
  return set;
}

/// True if the sign of t, or that it is zero, could be the work of rounding.
bool is_doubtful(const InteriorPoint& interior, bool is_zero, double scale) {
  if (is_zero) return std::max(std::abs(interior.slack), interior.infeasibility) > tolerance::kNoise * scale;
  return interior.infeasibility > 0.5 * std::abs(interior.slack);
}

/// Multiplies a virtual motion back: the load does work, and no open edge of a contact resists by more than
/// rounding.
bool proves_emptiness(const ContactMatrix& contacts, const Eigen::VectorXd& motion) {
  const double largest = motion.lpNorm<Eigen::Infinity>();
  const double power = motion.dot(contacts.wrench) / largest;
  const Eigen::VectorXd along_edges = contacts.edge_matrix.transpose() * (motion / largest);
  const double resistance = along_edges.size() > 0 ? std::max(0.0, -along_edges.minCoeff()) : 0;
  // What the load could do against that resistance must be small beside what it does.
  return resistance * contacts.wrench.lpNorm<1>() < 1e-3 * power;
}

/// A full-dimensional set with a point in its interior.
struct InteriorSet {
  FeasibleSet set;
  Eigen::VectorXd z;
};

/// Poses the problem again with ever more edges closed, until F is empty (returns nothing) or
/// full-dimensional in what is left.
std::optional<InteriorSet> reduce_to_full_dimension(const Packing& packing, const LpOptions& options,
                                                    ForcePolytope& polytope) {
  NullSpace null_space = polytope.null_space;
  for (;;) {
    ContactMatrix& contacts = polytope.contacts;
    polytope.rank_ambiguous = polytope.rank_ambiguous || null_space.ambiguous;
    polytope.doubtful = polytope.doubtful || null_space.ambiguous;
    if (null_space.unbalanced.size() > 0) {
      set_motion(packing, contacts, null_space.unbalanced, polytope);
      return {};
    }
    FeasibleSet set = feasible_set(contacts, null_space);
    const InteriorPoint interior = find_interior_point(set, options);
    polytope.pivots += interior.pivots;
    ++polytope.solves;
    polytope.interior_slack = interior.slack;
    const double largest =
        null_space.particular.size() > 0 ? null_space.particular.lpNorm<Eigen::Infinity>() : 0.0;
    const double scale = std::max(1.0, largest);
    const bool is_zero = std::abs(interior.slack) <= tolerance::kImplicitEquality * scale;
    polytope.doubtful = polytope.doubtful || is_doubtful(interior, is_zero, scale);
    if (!is_zero && interior.slack > 0) return InteriorSet{set, interior.z};
    if (!is_zero) {
      const Eigen::VectorXd velocities = contacts.to_edges.transpose() * interior.multipliers;
      Eigen::VectorXd motion = motion_from_contacts(contacts.matrix, velocities);
      if (motion.dot(contacts.wrench) < 0) motion = -motion;
      polytope.doubtful = polytope.doubtful || !proves_emptiness(contacts, motion);
      set_motion(packing, contacts, motion, polytope);
      return {};
    }
    std::vector<ContactMode> modes = contacts.modes;
    const double significant = interior.multipliers.maxCoeff() * tolerance::kReducedCost;
    for (int k = 0; k < set.inequalities(); ++k) {
      if (interior.multipliers[k] <= significant) continue;
      const Edge& edge = contacts.edges[static_cast<std::size_t>(k)];
      ContactMode& mode = modes[static_cast<std::size_t>(edge.contact.value())];
      mode = close_edge(mode, edge.sign);
    }
    contacts = build_contact_matrix(packing, modes);
    null_space = compute_null_space(contacts.matrix, contacts.wrench);
  }
}

Vertex find_lightest_vertex(const ContactMatrix& contacts, const InteriorSet& interior,
                            const LpOptions& options, ForcePolytope& polytope) {
  const FeasibleSet& set = interior.set;
  std::vector<std::pair<int, double>> normal_forces;
  for (int k = 0; k < set.inequalities(); ++k)
    normal_forces.emplace_back(k, -contacts.edges[static_cast<std::size_t>(k)].R);
  LpSolver solver(set, Formulation::kDual, options);
  const Objective lightness = make_objective(set, normal_forces);
  const LpAnswer answer = solver.maximise(lightness, walk_to_vertex(set, interior.z, lightness.along_z));
  polytope.pivots += answer.pivots;
  ++polytope.solves;
  if (answer.status != LpStatus::kOptimal)
    throw LibraryError("no vertex of the force polytope could be found");
  return compute_vertex(set, answer.basis);
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
  polytope.natural = build_contact_matrix(packing, natural_modes(packing));
  polytope.null_space = compute_null_space(polytope.natural.matrix, polytope.natural.wrench);
  polytope.contacts = polytope.natural;
  const std::optional<InteriorSet> interior = reduce_to_full_dimension(packing, options, polytope);
  if (!interior) return polytope;

  const FeasibleSet& set = interior->set;
  polytope.dim = set.dim();
  if (polytope.dim == 0) {
    polytope.status = PolytopeStatus::kPoint;
    polytope.lightest = set.offset;
    return polytope;
  }
  RecessionRay ray = find_recession_ray(set, options);
  polytope.pivots += ray.pivots;
  ++polytope.solves;
  polytope.doubtful = polytope.doubtful || ray.infeasibility > ray.noise;
  polytope.ray = std::move(ray.x);
  polytope.status = polytope.ray.size() > 0 ? PolytopeStatus::kUnbounded : PolytopeStatus::kBounded;
  const Vertex lightest = find_lightest_vertex(polytope.contacts, *interior, options, polytope);
  polytope.lightest = lightest.x;
  polytope.blocks = split_into_blocks(polytope.contacts, set, lightest);
  return polytope;
}

Eigen::VectorXd contact_state(const ForcePolytope& polytope, const Eigen::VectorXd& x) {
  return polytope.contacts.edge_forces * x;
}

}  // namespace indet
