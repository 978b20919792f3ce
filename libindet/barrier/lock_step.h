#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "libindet/barrier/analytic_centre.h"
#include "libindet/barrier/block_structure.h"

namespace indet::barrier {

/// Least value of Σ weight · x_column over the set.
using Objective = std::vector<std::pair<int, double>>;

struct LockStepOptions {
  /// Stop when Σ x_k s_k, which is c·x − b·y where the constraints hold, is below this, relative to
  /// max(least, |c·x|).
  double gap = 1e-6;
  double least = 1;  ///< in the unit of the problem
  int most_iterations = 100;
  /// Of μ that a step aims at at least. A higher aim takes more iterations, but keeps A x = b better where
  /// the optimum is degenerate.
  double least_aim = 1e-8;
  int vector_bits = 512;  ///< the widest registers to use, if the processor has them: 512, 256 or 128
};

/// Where the iteration for one objective ended.
struct Iterate {
  std::size_t objective = 0;
  std::span<const double> x;  ///< one a column
  std::span<const double> y;  ///< one a row, in the structure's order
  int iterations = 0;
  bool converged = false;  ///< the gap is reached; if not, this is the best iterate that was seen
};

/// Minimises many objectives over {A x = b, x ≥ 0} by the primal-dual interior point method of Mehrotra (SIAM
/// J. Optim. 2, 575 (1992); Wright, Primal-Dual Interior-Point Methods, ch. 10):
///
///   A x = b,   Aᵀ y + s = c,   x_k s_k = μ → 0,   x, s > 0
///
/// Rows may be elastic (BlockSystem): A x + g y = b there, which adds |b − A x|²/2g to what is minimised.
///
/// Eight objectives go in step, one a lane of vector registers: all have the same A, so the factorisation of
/// A X S⁻¹ Aᵀ is the same sequence of operations for each. A lane that is done takes the next objective, so
/// the lanes stay busy whatever the number of iterations. Each starts at the analytic centre (x_c, y_c): with
/// a large enough μ
///
///   x = x_c,   y = −μ y_c,   s = c + μ / x_c
///
/// is strictly feasible, so that bounds of the value are there from the first step on. Lanes do not feel each
/// other, the width is the same with every instruction set, and nothing is fused, so the results are the same
/// bits on any machine and in any order.
///
/// What comes out is close to a solution, but proves nothing yet: A x = b holds up to rounding that can grow
/// large in the last steps (verified_equations.h mends that).
///
/// `next` hands out the number of the objective that comes next, nothing when there is none; `finish` takes
/// the result; `objective` gives the objective of a number. They may be called from other threads' runs too.
/// `keep_on` is asked once an iteration; if it says no the run ends at once.
struct LockStepCalls {
  std::function<std::optional<std::size_t>()> next;
  std::function<Objective(std::size_t)> objective;
  std::function<void(const Iterate&)> finish;
  std::function<bool()> keep_on;
  std::function<double(std::size_t)> give = {};  ///< g > 0 of an objective; where rows are elastic
};
void minimise_in_lock_step(const BlockStructure& structure, const AnalyticCentre& centre,
                           const LockStepOptions& options, const LockStepCalls& calls);

/// The widest vector registers, in bits, that are used here: 512, 256 or 128.
int vector_bits();

}  // namespace indet::barrier
