#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>

namespace indet {

/// How ranges are to be estimated.
struct EstimateOptions {
  /// K: contacts whose ranges are found, for the estimates of all others; 0: stored coefficients alone.
  int calibration = 20;
  std::uint64_t seed = 1;  ///< draws these contacts
};

/// The probability that prediction intervals are made for.
inline constexpr double kCoverage = 0.95;

/// Predictions of one of δR and δT, in mg; [M], NaN where the range is known. Each interval is meant to hold
/// δ of its contact with probability kCoverage.
struct DeltaEstimates {
  Eigen::VectorXd estimate, low, high;
};

/// What an analysis tells of contacts whose ranges it does not look for (estimated_ranges.h).
struct Estimates {
  int calibration = -1;  ///< K as asked for; −1: nothing is estimated, and the tables have no rows.
  double coverage = std::numeric_limits<double>::quiet_NaN();
  Eigen::Array<std::uint8_t, Eigen::Dynamic, 1>
      calibrates;  ///< [M], 1: the contact was drawn for calibration.
  DeltaEstimates estimated_R, estimated_T;
};

}  // namespace indet
