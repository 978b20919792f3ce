#pragma once

#include <Eigen/Core>
#include <vector>

#include "libindet/packing/packing.h"
#include "libindet/polytope/force_polytope.h"

namespace indet {

/// What small turns of the normals may do to the decisions that a polytope rests on. F is found on the edges
/// that are open somewhere in it; in the turned packing
///
///   - fewer states may be left, where equations are dependent that need not stay so. Two kinds do no harm:
///     groups of bodies that touch nothing fixed translate, which moves no contact; and a disk that rests on
///     one contact alone may roll about it. Its force is determined, and either the disk rolls off, so that F
///     is empty, or nothing else changes;
///   - edges may open that were closed throughout F.
///
/// With neither, F moves continuously as long as it is not empty, and to first order its values do what
/// duality says (sensitivity_bounds.h). Bodies that carry nothing and hang on one contact at a time change
/// nothing: that contact stays closed.
class TurnedStructure {
 public:
  /// `polytope` must outlive this.
  explicit TurnedStructure(const ForcePolytope& polytope);

  bool stays_full() const { return stays_full_; }
  /// There are edges that may open.
  bool may_open() const { return !closed_.empty(); }
  /// No force of the contact is other than 0, however the normals turn a little.
  bool stays_open(Eigen::Index contact) const { return loose_[static_cast<std::size_t>(contact)]; }
  /// No edge that may open raises a maximum of sign · R or sign · T of a contact: (Aᵀ y)_k ≥ c_k for the
  /// multipliers y (one entry an equation of ForcePolytope::problem).
  bool resists_opening(Eigen::Index contact, bool tangential, double sign, const Eigen::VectorXd& y) const;

 private:
  void find_loose_contacts();
  void find_closed_edges();
  void find_deficiency();
  int rolling_disks() const;

  const ForcePolytope& polytope_;
  std::vector<bool> loose_;          ///< a contact
  std::vector<int> closed_;          ///< edges of the natural problem
  std::vector<int> natural_of_row_;  ///< of each equation of the problem, its number in the natural one
  bool stays_full_ = false;
};

}  // namespace indet
