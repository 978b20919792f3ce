#include "libindet/range/sensitivity_bounds.h"

#include <algorithm>
#include <cmath>

#include "libindet/base/constants.h"
#include "libindet/base/tolerances.h"
#include "libindet/range/dual_face.h"

namespace indet {
namespace {

constexpr Sensitivity kUnknown{kInfinity, SensitivityClaim::kBound};
constexpr Sensitivity kUnmoved{0, SensitivityClaim::kExact};
constexpr auto kNoBlock = static_cast<std::size_t>(-1);

/// The ends of factor · [low, high], where NaN is no limit.
double greatest_product(double factor, double low, double high) {
  if (factor == 0) return 0;
  const double end = factor > 0 ? high : low;
  return std::isnan(end) ? kInfinity : factor * end;
}

/// The greatest |on_R R + on_T T| within the ranges.
double greatest_within(double on_R, double on_T, const Eigen::Ref<const Eigen::Array<double, 1, 4>>& ranges) {
  double greatest = 0;
  for (const double sign : {-1.0, 1.0}) {
    greatest = std::max(greatest, greatest_product(sign * on_R, ranges[kMinR], ranges[kMaxR]) +
                                      greatest_product(sign * on_T, ranges[kMinT], ranges[kMaxT]));
  }
  return greatest;
}

}  // namespace

SensitivityBounds::SensitivityBounds(const ForcePolytope& polytope, const Table4<double>& ranges)
    : polytope_(polytope), problem_(polytope.problem), ranges_(ranges), structure_(polytope) {}

std::vector<bool> SensitivityBounds::contacts_beside(std::size_t block) const {
  std::vector<bool> result(problem_.contacts.size(), false);
  for (std::size_t other = 0; other < polytope_.blocks.size(); ++other) {
    if (other == block) continue;
    for (const int k : polytope_.blocks[other].edges) {
      const Edge& edge = problem_.edge(k);
      if (!edge.is_slack()) result[static_cast<std::size_t>(edge.contact.value())] = true;
    }
  }
  return result;
}

Sensitivity SensitivityBounds::greatest(Eigen::Index contact, int column,
                                        const std::vector<Eigen::VectorXd>& motions,
                                        const SceneForces& forces, const std::vector<bool>& varies) const {
  if (!structure_.stays_full()) return kUnknown;
  const double sign = column == kMaxR || column == kMaxT ? 1 : -1;
  double greatest = 0;
  bool rises_no_further = false;
  bool depends_on_state = false;
  for (const Eigen::VectorXd& motion : motions) {
    rises_no_further = rises_no_further || structure_.resists_opening(contact, column >= kMinT, sign, motion);
    const double rest = tolerance::kRestingContact * std::max(1.0, motion.lpNorm<Eigen::Infinity>());
    const Eigen::Matrix2d compression = problem_.compression_of(motion);
    double sum = 0;
    for (std::size_t i = 0; i < problem_.contacts.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      const Vector2 velocity = relative_velocity(problem_, motion, compression, i);
      const ContactEnds& ends = problem_.contacts[i];
      if (!varies[i]) {
        sum += std::abs(velocity.dot(forces.value()[2 * row + 1] * ends.normal -
                                     forces.value()[2 * row] * ends.tangent()));
      } else if (velocity.lpNorm<Eigen::Infinity>() > rest) {
        depends_on_state = true;
        sum += greatest_within(-velocity.dot(ends.tangent()), velocity.dot(ends.normal), ranges_.row(row));
      }
    }
    greatest = std::max(greatest, sum);
  }
  const bool is_limited = polytope_.status != PolytopeStatus::kUnbounded || !depends_on_state;
  if (!rises_no_further || !is_limited) return kUnknown;
  const bool is_exact = !depends_on_state && !structure_.may_open();
  return {greatest, is_exact ? SensitivityClaim::kExact : SensitivityClaim::kBound};
}

Sensitivity SensitivityBounds::at_vertex(Eigen::Index contact, int column, std::size_t block,
                                         const Vertex& vertex, const Eigen::VectorXd& multipliers,
                                         const SceneForces& forces, const MotionOf& motion_of) const {
  const PolytopeBlock& own = polytope_.blocks[block];
  const DualFace face = find_dual_face(own.view, vertex, multipliers);
  if (!face.is_whole) return kUnknown;
  std::vector<Eigen::VectorXd> motions;
  for (const Eigen::VectorXd& costs : face.vertices) {
    Eigen::VectorXd on_edges = Eigen::VectorXd::Zero(problem_.unknowns());
    for (std::size_t k = 0; k < face.tight.size(); ++k)
      on_edges[own.edges[static_cast<std::size_t>(face.tight[k])]] = costs[static_cast<Eigen::Index>(k)];
    motions.push_back(motion_of(on_edges));
  }
  const std::size_t fixed = face.has_one_state ? block : kNoBlock;
  return greatest(contact, column, motions, forces, contacts_beside(fixed));
}

Sensitivity SensitivityBounds::everywhere(Eigen::Index contact, int column, const Eigen::VectorXd& motion,
                                          const SceneForces& forces) const {
  return greatest(contact, column, {motion}, forces, contacts_beside(kNoBlock));
}

Sensitivity SensitivityBounds::at_point(Eigen::Index contact, int column, const Eigen::VectorXd& motion,
                                        const SceneForces& forces) const {
  return greatest(contact, column, {motion}, forces, std::vector<bool>(problem_.contacts.size(), false));
}

Sensitivity SensitivityBounds::closed(Eigen::Index contact, int column) const {
  if (!structure_.stays_full()) return kUnknown;
  return column == kMinR || structure_.stays_open(contact) ? kUnmoved : kUnknown;
}

}  // namespace indet
