#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "libindet/packing/packing.h"

namespace indet {

/// One side of what a scene allows a force F_k (R or T of one contact): a measured force with its error, or
/// a contact that carries at most so much.
///
///   kLower  F_k ≥ value      kUpper  F_k ≤ value      kEqual  F_k = value
struct ForceBound {
  enum class Side { kLower, kUpper, kEqual };

  ContactId contact;
  bool tangential = false;  ///< of T, else of R
  Side side = Side::kLower;
  double value = 0;  ///< in the scene's units, like the others
  /// Of the other side, where both are given: hi of a kLower, lo of a kUpper; else infinite.
  double other = std::numeric_limits<double>::infinity();
  /// Its number among the half-planes of the problem: 2α and 2α + 1 are the edges of the cone of contact α;
  /// then come the bounds of the whole scene in their order, those of kEqual left out: they have −1.
  int half_plane = -1;

  int component() const { return 2 * contact.value() + (tangential ? 1 : 0); }  ///< of (R_1, T_1, …)
  bool is_two_sided() const {
    return other < std::numeric_limits<double>::infinity() &&
           other > -std::numeric_limits<double>::infinity();
  }
  /// Half of what is left to the force: (hi − lo)/2, hi/2 of an R without lo; infinite where it is open to
  /// one side.
  double half_interval() const {
    if (is_two_sided()) return std::abs(value - other) / 2;
    return side == Side::kUpper && !tangential ? value / 2 : std::numeric_limits<double>::infinity();
  }
};

/// The bounds that say more than friction does, contact by contact, R before T, lower before upper. Left out
/// are R ≥ lo for lo ≤ 0, and bounds of T where μ = 0 and 0 lies between them. Where lo = hi, or R ≤ 0, one
/// kEqual takes the place of both. Precondition: find_defect(packing) is empty.
std::vector<ForceBound> force_bounds(const Packing& packing);

/// How far forces (R_1, T_1, …) are inside of a bound (negative: outside), in their unit; of a kEqual
/// −|F − value|.
double slack(const ForceBound& bound, const Eigen::VectorXd& forces, double unit = 1);

/// "R of contact 5 (12–7) ≤ 3.2", with values over `unit`.
std::string bound_name(const Packing& packing, const ForceBound& bound, double unit = 1);

}  // namespace indet
