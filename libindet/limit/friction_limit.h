#pragma once

#include <vector>

#include "libindet/limit/load_limits.h"

namespace indet {

/// The least friction with which a packing stands: the infimum of the factors s such that contact forces
/// balance the load with |T| ≤ s μ R at the contacts of `scaled` (one flag a contact), and |T| ≤ μ R at the
/// others. The more friction, the larger the cones, so that it stands with every larger factor.
///
/// The largest t with all strengths x ≥ t, a linear program, is negative below s and not above it. Its zero
/// is found by bracketing (Alefeld, Potra and Shi, ACM Trans. Math. Softw. 21, 327 (1995)), or, where t is 0
/// above s, too, since some contacts transmit nothing whatever their friction, by halves in exact arithmetic.
/// It is proven in exact arithmetic that it falls just below and stands just above, with the coefficients of
/// friction rounded to doubles.
struct FrictionLimit {
  /// The infimum with forces just above and a motion that proves that it falls just below.
  ///   kReached  at 0: no friction is needed
  ///   kNoState  no friction suffices, up to the factor `lower` at least, of which it is proven
  LimitEnd infimum;
  /// It stands with the infimum itself, as far as forces just above tell: they are compared at two distances.
  /// Not so where forces grow without limit as s falls to it: a column between two walls needs some friction,
  /// however little.
  bool is_attained = true;
};

/// Preconditions: find_defect(packing) is empty; one flag a contact, and some contact with μ > 0 has it.
FrictionLimit find_friction_limit(const Packing& packing, const std::vector<bool>& scaled,
                                  const LimitOptions& options = {});

/// The packing with μ of these contacts multiplied.
Packing with_friction(Packing packing, const std::vector<bool>& scaled, double factor);

}  // namespace indet
