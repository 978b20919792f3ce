#pragma once

#include <cstdint>
#include <string>

#include "libindet/limit/load_limits.h"
#include "libindet/packing/loads.h"

namespace indet {

/// What is varied until no contact forces balance the loads any more.
enum class LimitKind : std::uint8_t {
  kTilt,  ///< the direction of gravity, by an angle in rad, counter-clockwise positive (tilt.h)
  kLoad   ///< what acts, by a multiple λ of `change` (load_limits.h)
};
inline constexpr LimitKind kLimitKinds[] = {LimitKind::kTilt, LimitKind::kLoad};
const char* to_string(LimitKind kind);

/// Both ends of what a packing can take, as files hold it.
struct Limit {
  LimitKind kind = LimitKind::kTilt;
  std::string load;  ///< how the user called it
  Loads change;      ///< of kLoad; else 0
  LimitEnd smallest, largest;
  /// Of kTilt: something takes part that does not turn with gravity, so that it may stand again further on.
  bool is_first_of_several = false;

  /// It stands as it is.
  bool stands() const { return smallest.upper <= 0 && largest.lower >= 0; }
  bool is_decided() const {
    return smallest.outcome != LimitOutcome::kUndecided && largest.outcome != LimitOutcome::kUndecided;
  }
};

Limit find_tilt(const Packing& packing, const LimitOptions& options = {});
Limit find_load(const Packing& packing, std::string name, Loads change, const LimitOptions& options = {});

/// The packing under the load of one of its ends. Precondition: that is reached.
Packing at_end(const Packing& packing, const Limit& limit, const LimitEnd& end);

}  // namespace indet
