#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "libindet/lp/feasible_set.h"

namespace indet {

/// How the paper's search for an interior point ended.
enum class InteriorEnd : std::uint8_t {
  kFound,
  kUnknown,     ///< there is no simulated state
  kOutside,     ///< the simulated state does not balance, or violates the contact conditions
  kTightCorner  ///< no way leads off some sliding contact while the others are kept
};
inline constexpr int kInteriorEnds = 4;
const char* to_string(InteriorEnd end);

struct InteriorStart {
  InteriorEnd end = InteriorEnd::kUnknown;
  Eigen::VectorXd z;  ///< d: no inequality is active there; empty if none was found
  int sliding = 0;    ///< inequalities that were active at the simulated state
  int left = 0;       ///< of these, how many were left
};

/// The paper's start (Sec. II G): a point of the set in which no contact slides, from a simulated state. One
/// active inequality after the other is left along a direction that preserves all other active ones, half of
/// the way to the next inequality. This can fail where the state lies in a tight corner; the paper then takes
/// another simulated state.
///
/// `simulated`: x of the simulated state, K, in force units. Active is what is below `epsilon`.
InteriorStart leave_sliding_contacts(const SlopeView& view, const Eigen::VectorXd& simulated, double epsilon);

}  // namespace indet
