#pragma once

#include <Eigen/Core>
#include <limits>
#include <string>

#include "libindet/packing/packing.h"
#include "libindet/polytope/force_polytope.h"

namespace indet {

/// The equilibrium problem of a packing and its polytope F in numbers: the first stage of an analysis.
/// M contacts, N disks. Fields start at impossible values.
struct ProblemSummary {
  PolytopeStatus status = PolytopeStatus::kEmpty;
  int unknowns = -1;   ///< Columns of c that the scene needs: 2 a contact, 1 where μ = 0; slacks of bounds.
  int equations = -1;  ///< Rows of c that the scene needs, and bounds of forces.
  int rank = -1;       ///< rank c.
  int nullity = -1;    ///< d = dim ker c ≥ 2M − 3N [8].
  int dim = -1;        ///< dim F; −1 when F is empty.
  int blocks = -1;     ///< Independent parts of F; −1 where they are not known.
  std::string blocks_reason;  ///< Then, why.
  bool rank_ambiguous = false;
  /// Rational arithmetic found all of the results, from the polytope on (exact_ranges.h).
  bool exact = false;
  /// Relative size of a change of the packing's numbers that may alter a decision about F (rank, closed
  /// contacts, emptiness, boundedness), estimated; NaN where none lies within rounding.
  double hairline = std::numeric_limits<double>::quiet_NaN();
  /// Smallest accepted over largest rejected singular value (estimates), and these two.
  double rank_gap = std::numeric_limits<double>::quiet_NaN();
  double smallest_accepted = std::numeric_limits<double>::quiet_NaN();
  double largest_rejected = std::numeric_limits<double>::quiet_NaN();
  double force_unit = std::numeric_limits<double>::quiet_NaN();  ///< mg in the scene's units.
  /// [N, 3] virtual velocity x, y and r·ω of each disk when F is empty.
  Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> motion;
  /// [W, 2] the same of walls, along normal and tangent, where some wall is loaded.
  Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor> wall_motion;
  /// [2, 2] the rate of compression of the cell times its length, where stress is imposed.
  Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor> cell_motion;
  /// When F is empty: multipliers of the scene's bounds of forces (ForcePolytope::bound_multipliers).
  Eigen::VectorXd bound_multipliers;
};

ProblemSummary summarise(const Packing& packing, const ForcePolytope& polytope);

}  // namespace indet
