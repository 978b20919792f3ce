#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "libindet/limit/load_limits.h"
#include "libindet/packing/loads.h"

namespace indet {

/// What is varied until no contact forces balance the loads any more.
enum class LimitKind : std::uint8_t {
  kTilt,     ///< the direction of gravity, by an angle in rad, counter-clockwise positive (tilt.h)
  kLoad,     ///< what acts, by a multiple λ of `change` (load_limits.h)
  kFriction  ///< the coefficients of friction of `scaled` contacts, by a factor (friction_limit.h)
};
inline constexpr LimitKind kLimitKinds[] = {LimitKind::kTilt, LimitKind::kLoad, LimitKind::kFriction};
const char* to_string(LimitKind kind);

/// Both ends of what a packing can take, as files hold it.
struct Limit {
  LimitKind kind = LimitKind::kTilt;
  std::string name;          ///< how the user called it
  Loads change;              ///< of kLoad; else 0
  std::vector<bool> scaled;  ///< of kFriction: which contacts; else empty
  LimitEnd smallest, largest;
  /// Of kLoad, one of those that map the plane of two loads: the change is cos φ times the first one and sin
  /// φ times the second one. NaN: it is alone.
  double map_angle = std::numeric_limits<double>::quiet_NaN();
  /// Of kFriction: it stands with the smallest factor itself (FrictionLimit::is_attained).
  bool is_attained = true;
  /// Of kTilt: it may stand at other angles, too, that do not join these (TiltLimits).
  bool is_first_of_several = false;
  /// Disks that were taken out, in this order: forces of their contacts are 0, and they do not move.
  std::vector<DiskId> left_out;

  /// The angle, multiple or factor of the packing as it is.
  double present() const { return kind == LimitKind::kFriction ? 1 : 0; }
  /// There is a way from the packing as it is to this end: it stands, and the end is reached elsewhere.
  bool has_way_to(const LimitEnd& end) const {
    return stands() && end.outcome == LimitOutcome::kReached && end.value != present();
  }
  /// It is proven to stand as it is; it is proven not to.
  bool stands() const { return smallest.upper <= present() && largest.lower >= present(); }
  bool falls() const {
    return smallest.outcome == LimitOutcome::kNoState || present() < smallest.lower ||
           present() > largest.upper;
  }
  bool is_decided() const {
    return (stands() || falls()) && smallest.outcome != LimitOutcome::kUndecided &&
           largest.outcome != LimitOutcome::kUndecided;
  }
};

/// The packing without some disks: they are fixed, and have no contacts. Their weight goes with them; the
/// unit of force stays.
Packing without(Packing packing, const std::vector<DiskId>& disks);

/// A disk that lies loosely on others rolls away at a small angle, which says little about the packing. So as
/// long as a mechanism moves one disk alone, at an angle below `ignore_below` (rad), and the packing stands
/// without it, that disk is taken out.
Limit find_tilt(const Packing& packing, double ignore_below = 0, const LimitOptions& options = {});
Limit find_load(const Packing& packing, std::string name, Loads change, const LimitOptions& options = {});

/// The packing whose contacts the mechanism of an end is about: without what was left out, and with the
/// friction just below a limit of friction.
Packing under_mechanism(const Packing& packing, const Limit& limit, const LimitEnd& end);

/// `scaled`: as of find_friction_limit.
Limit find_friction(const Packing& packing, std::string name, std::vector<bool> scaled,
                    const LimitOptions& options = {});

/// The packing, without what was left out, tilted by the angle `value`, under that multiple of the load, or
/// with that factor of friction.
Packing packing_at(const Packing& packing, const Limit& limit, double value);

}  // namespace indet
