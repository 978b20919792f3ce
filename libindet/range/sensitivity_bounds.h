#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <vector>

#include "libindet/lp/vertex.h"
#include "libindet/packing/force.h"
#include "libindet/polytope/force_polytope.h"
#include "libindet/range/outcome.h"
#include "libindet/range/sensitivity.h"
#include "libindet/range/turned_structure.h"

namespace indet {

/// How far optimal values move at most, whichever of several states and multipliers a search has found. Along
/// a turn ε of the normals a maximum changes, to first order, by (Gol'shtein)
///
///   max over the states F that attain it of the min over the optimal y of
///       Σ_α ε_α v_α · (T_α n̂_α − R_α t̂_α)
///
/// where F has an interior. Its size is no more than the greatest s(y, F) (sensitivity.h) of both faces, and
/// where there is one state only, the value falls as far along some turn. s is convex in y, so that its
/// greatest value is at a vertex of the dual face (dual_face.h). Forces that differ between states that
/// attain the value are taken to be anywhere within their ranges, contact by contact.
///
/// Only such turns are meant as leave the packing some admissible state. The bound is +inf where turning may
/// leave fewer states than a small change of the forces accounts for (turned_structure.h), where an edge may
/// open that is closed throughout F and along which the value would grow, where several states attain a value
/// and F is unlimited, where the dual face has too many vertices, and where forces matter whose ranges are
/// not known.
class SensitivityBounds {
 public:
  /// `ranges`: R_min, R_max, T_min, T_max of all contacts, in the scene's units, NaN where not known. Both
  /// must outlive this.
  SensitivityBounds(const ForcePolytope& polytope, const Table4<double>& ranges);

  /// For reduced costs h̃ ≥ 0 of the edges, the y with Aᵀ y = c + h̃ (one entry an equation), c that of the
  /// maximum of R or T or of minus these.
  using MotionOf = std::function<Eigen::VectorXd(const Eigen::VectorXd& costs)>;

  /// Of a value that a vertex of a block attains. `multipliers`: the reduced costs of its basis, in its
  /// order; `forces`: the vertex with any state of other blocks.
  Sensitivity at_vertex(Eigen::Index contact, int column, std::size_t block, const Vertex& vertex,
                        const Eigen::VectorXd& multipliers, const SceneForces& forces,
                        const MotionOf& motion_of) const;
  /// Of a value that all states attain, `forces` of any; `motion`: y with Aᵀ y = c.
  Sensitivity everywhere(Eigen::Index contact, int column, const Eigen::VectorXd& motion,
                         const SceneForces& forces) const;
  /// Of a value that one state alone attains and one motion alone proves.
  Sensitivity at_point(Eigen::Index contact, int column, const Eigen::VectorXd& motion,
                       const SceneForces& forces) const;
  /// Of a force that is 0 because no edge of its contact is open.
  Sensitivity closed(Eigen::Index contact, int column) const;

 private:
  /// `varies`: the contacts whose forces differ between the states that attain the value.
  Sensitivity greatest(Eigen::Index contact, int column, const std::vector<Eigen::VectorXd>& motions,
                       const SceneForces& forces, const std::vector<bool>& varies) const;
  /// The contacts of all blocks but one.
  std::vector<bool> contacts_beside(std::size_t block) const;

  const ForcePolytope& polytope_;
  const EquilibriumProblem& problem_;
  const Table4<double>& ranges_;
  TurnedStructure structure_;
};

}  // namespace indet
