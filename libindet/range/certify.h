#pragma once

#include <cstdint>
#include <limits>

#include "libindet/packing/packing.h"
#include "libindet/range/enclosure.h"
#include "libindet/range/extrema.h"
#include "libindet/range/outcome.h"
#include "libindet/range/problem_summary.h"

namespace indet {

/// The values and what may be said of each: the fourth stage of an analysis. M contacts, columns R_min,
/// R_max, T_min, T_max. Forces are in the scene's units; residuals are dimensionless.
struct Certified {
  /// Some decision about F (rank, emptiness, dimension, boundedness) lies within rounding: every result is
  /// imprecise.
  bool doubtful = false;
  Table4<double> value;         ///< ±inf where unbounded, NaN where not found.
  Table4<double> lower, upper;  ///< Enclosure of the value; infinite where nothing is proven.
  Sensitivities sensitivity;
  Table4<Outcome> outcome;
  Table4<double> primal_residual, dual_residual;
  /// Objectives by outcome; `certified` are optimal, unbounded or enclosed.
  std::int64_t objectives = 0, certified = 0, unbounded = 0, enclosed = 0, imprecise = 0, failed = 0;
  double worst_primal_residual = std::numeric_limits<double>::quiet_NaN();
  double worst_dual_residual = std::numeric_limits<double>::quiet_NaN();
  double residual = std::numeric_limits<double>::quiet_NaN();  ///< Largest ‖cF + w‖∞ over the extremal
                                                               ///< states, kept or not, in force units.
};

/// Takes the values and the residuals of their states, or the middle of the interval where there is no state,
/// lets go of enclosures that rest on a decision about F which is in doubt, and lets residuals and the
/// width of the enclosure (promise.h), or the width of the interval, decide between certified and
/// `imprecise`; then counts outcomes. Where F is empty all objectives count, and none has an outcome.
Certified certify(const Packing& packing, const ProblemSummary& problem, const Extrema& extrema,
                  const Enclosures& enclosures);

}  // namespace indet
