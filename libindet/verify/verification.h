#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace indet {

/// What the check of one part of a file found.
struct Verification {
  static constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

  std::int64_t checks = 0;            ///< comparisons made
  std::int64_t contradictions = 0;    ///< comparisons that failed
  std::vector<std::string> messages;  ///< the first twenty contradictions: place, stored and right number

  std::int64_t states = 0;             ///< contact states that were checked against the packing
  double worst_imbalance = kNaN;       ///< ‖cF + w‖∞ over these (mg); NaN: there are none
  double worst_violation = kNaN;       ///< of the contact conditions, over these (mg); NaN: there are none
  std::int64_t optima = 0;             ///< values whose optimality was proven from the packing
  double worst_optimality_gap = kNaN;  ///< over these, dimensionless; NaN: there are none

  /// What is stored and was not computed a second time, with the reason.
  std::vector<std::string> unchecked;
  /// What the file itself says is imprecise or was not solved.
  std::vector<std::string> unsolved;
  /// What else the file says of itself: nothing that is stored rests on it.
  std::vector<std::string> remarks;

  bool passed() const { return contradictions == 0; }
};

}  // namespace indet
