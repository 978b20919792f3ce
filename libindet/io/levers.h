#pragma once

#include <optional>
#include <string>
#include <vector>

namespace indet {

/// Where a code applies the force of a contact: at the surface of the undeformed disk, arm r, or at the
/// middle of the overlap δ, arm r − δ/2 (of both disks alike; at a wall δ/2 is half of what the wall cuts
/// off).
enum class Lever { kRadius, kMidOverlap };

/// At contacts of two disks, and of a disk and a wall.
struct Levers {
  Lever pair = Lever::kRadius;
  Lever wall = Lever::kRadius;
  bool operator==(const Levers&) const = default;
};

/// What the user says about levers; what is not said is found out.
struct LeverRule {
  std::optional<Lever> pair, wall;

  /// "radius", "mid-overlap", or "pair=…" and "wall=…". Throws InputError for anything else.
  static LeverRule parse(const std::vector<std::string>& items);
  bool allows(const Levers& levers) const {
    return pair.value_or(levers.pair) == levers.pair && wall.value_or(levers.wall) == levers.wall;
  }
};

std::string name_of(Lever lever);           ///< "radius", "mid-overlap"
std::string name_of(const Levers& levers);  ///< "pair=mid-overlap,wall=radius"

/// One choice, and the largest net torque on a free disk that the known forces leave with it (mg r).
struct LeverTrial {
  Levers levers;
  double residual = 0;
};

/// Which levers a packing got.
struct LeverChoice {
  Levers levers;
  /// Why: the user said so, these balance best, they balance as well as any other and the format documents
  /// them, none balances (then those that the format documents), or no forces are known to tell.
  enum class Reason { kGiven, kBest, kDocumented, kNone, kUnknown } reason = Reason::kUnknown;
  std::vector<LeverTrial> trials;  ///< Of all choices that the user allows; empty without forces.
};

}  // namespace indet
