#pragma once

#include "libindet/limit/load_limits.h"

namespace indet {

/// By what angles gravity can be turned before no contact forces balance it, counter-clockwise positive: the
/// ends are in rad, their forces and mechanisms those under turned gravity. Contacts, walls and what else
/// acts stay as they are.
struct TiltLimits {
  LimitEnd smallest, largest;
  /// Loads or bounds that do not turn with gravity take part, or the angles are one single angle: then the
  /// packing may stand at others, too, that do not join these.
  bool is_first_of_several = false;

  bool stands() const;
};

/// With gravity as the only load, forces for gravity g cos θ + g⊥ sin θ exist for a convex cone of
/// directions: t = tan θ is one linear program about each of four directions, θ = 0, ±90°, 180°, and where
/// one of them has no end, the next one has it. The angles are an interval of at most 180°, or all, or two
/// opposite ones (a smooth disk between two walls), of which one is found.
///
/// With other loads, walls that push, or bounds, (cos θ, sin θ) must lie in a convex set C that is not a
/// cone. The arc from one angle to a next one is in C if both are and the point where its tangents meet: such
/// arcs are put one after the other until a motion shows where the arc leaves C. Both sides are proven, at
/// angles about tolerance::kTilt from each other.
///
/// Preconditions: find_defect(packing) is empty; there is gravity.
TiltLimits find_tilt_limits(const Packing& packing, const LimitOptions& options = {});

/// Gravity is all that acts: forces for a multiple of it are the same multiple of those for gravity.
bool is_under_gravity_alone(Packing packing);

}  // namespace indet
