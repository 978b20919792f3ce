#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace indet {

/// What exact arithmetic says about one objective.
enum class Proof : std::uint8_t {
  kProven,     ///< the stored half-planes (or ray) are those of the exact optimum
  kRepaired,   ///< the exact optimum has other half-planes, found by exact pivots
  kRefuted,    ///< exactly, the outcome is another one: finite against unbounded, or no state at all
  kUndecided,  ///< the limit of pivots was reached
  kNotAsked    ///< not requested
};

/// How many objectives came out how, and how far stored values are from exact ones.
struct ExactTally {
  std::int64_t proven = 0, repaired = 0, refuted = 0, undecided = 0;
  std::int64_t pivots = 0;
  std::int64_t rational = 0;        ///< objectives at whose basis enclosures alone did not decide
  std::int64_t contradictions = 0;  ///< certified numbers whose enclosure does not contain the exact value
  double worst_error = 0;  ///< |stored − exact| over all finite values that agree in kind (mg; torques mg r)
  double worst_certified_error = 0;   ///< the same, over those stored as `optimal`
  std::vector<std::string> messages;  ///< the first twenty results that are not proven, or contradicted

  bool passed() const { return refuted == 0 && undecided == 0 && contradictions == 0; }
  void count(Proof proof);
  void add_message(std::string text);
  void add(const ExactTally& other);
};

}  // namespace indet
