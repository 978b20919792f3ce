#include "libindet/limit/tilt.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "libindet/base/constants.h"
#include "libindet/base/rounding_bounds.h"
#include "libindet/limit/tilt_arc.h"
#include "libindet/packing/force_bounds.h"

namespace indet {
namespace {

constexpr double kRightAngle = std::numbers::pi / 2;

/// Gravity about one of four directions, with λ = tan of the angle to it.
struct Quarter {
  Packing packing;
  Loads change;
  LoadLimitFinder finder;

  Quarter(Packing turned, Loads turn, const LimitOptions& options)
      : packing(std::move(turned)), change(std::move(turn)), finder(packing, change, options) {}
};

class TiltCone {
 public:
  TiltCone(const Packing& packing, const LimitOptions& options) : packing_(packing), options_(options) {}

  TiltLimits find() {
    TiltLimits limits;
    for (const int quarter : {0, 1, -1, 2}) {
      limits.largest = end_from(quarter, 1);
      if (limits.largest.outcome == LimitOutcome::kNoState) continue;
      limits.smallest = end_from(quarter, -1);
      complete(limits.smallest, limits.largest, -1);
      complete(limits.largest, limits.smallest, 1);
      // A line of directions: the opposite one may be balanced, too.
      limits.is_first_of_several =
          limits.largest.outcome == LimitOutcome::kReached && limits.largest.lower <= limits.smallest.upper;
      return limits;
    }
    limits.largest = limits.smallest = at(0).find(1);
    return limits;
  }

 private:
  /// Without an end one way there is none the other way.
  static void complete(LimitEnd& end, const LimitEnd& other, int sign) {
    if (other.outcome != LimitOutcome::kNever) return;
    end = LimitEnd();
    end.outcome = LimitOutcome::kNever;
    end.value = end.lower = end.upper = sign * kInfinity;
  }

  LoadLimitFinder& at(int quarter) {
    auto& slot = quarters_[quarter];
    if (!slot) {
      Packing start = packing_;
      start.gravity = turned(packing_.gravity, quarter * kRightAngle);
      Loads turn;
      turn.gravity = turned(packing_.gravity, (quarter + 1) * kRightAngle);
      slot = std::make_unique<Quarter>(std::move(start), std::move(turn), options_);
    }
    return slot->finder;
  }

  /// Where tan has no end about one direction, gravity along the next one is admissible.
  LimitEnd end_from(int first, int sign) {
    LimitEnd end;
    for (int k = 0; k < 4; ++k) {
      const int quarter = first + sign * k;
      end = at(quarter).find(sign);
      // Beyond a half turn, with the other directions of a convex cone, there is no end.
      if (end.outcome == LimitOutcome::kNever && k < 2) continue;
      if (end.outcome == LimitOutcome::kReached) to_angle(quarter, end);
      break;
    }
    return end;
  }

  static void to_angle(int quarter, LimitEnd& end) {
    const double start = quarter * kRightAngle;
    const auto angle = [&](double tangent) { return start + std::atan(tangent); };
    const double rounding = quarter == 0 ? 4 * kRoundoff * std::abs(angle(end.value)) : 16 * kRoundoff;
    // The load there is that of g + t g⊥, which is longer than g.
    end.forces = SceneForces(end.forces.value() / std::hypot(1, end.value));
    end.lower = angle(end.lower) - rounding;
    end.upper = angle(end.upper) + rounding;
    end.value = angle(end.value);
  }

  const Packing& packing_;
  LimitOptions options_;
  std::map<int, std::unique_ptr<Quarter>> quarters_;
};

}  // namespace

bool is_under_gravity_alone(Packing packing) {
  packing.gravity.setZero();
  const std::vector<ForceBound> bounds = force_bounds(packing);
  return loads_of(packing).is_zero() &&
         std::all_of(bounds.begin(), bounds.end(),
                     [](const ForceBound& bound) { return bound.value == 0 && !bound.is_two_sided(); });
}

bool TiltLimits::stands() const { return smallest.upper <= 0 && largest.lower >= 0; }

TiltLimits find_tilt_limits(const Packing& packing, const LimitOptions& options) {
  if (is_under_gravity_alone(packing)) return TiltCone(packing, options).find();
  return find_tilt_arc(packing, options);
}

}  // namespace indet
