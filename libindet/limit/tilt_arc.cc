#include "libindet/limit/tilt_arc.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "libindet/base/constants.h"
#include "libindet/base/rounding_bounds.h"
#include "libindet/base/tolerances.h"
#include "libindet/limit/mechanism.h"
#include "libindet/limit/standing.h"
#include "libindet/packing/force_bounds.h"

namespace indet {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
/// The arcs that are put one after the other are no longer than this.
constexpr double kLongestArc = std::numbers::pi / 3;
constexpr int kMostTests = 100;

/// The power of gravity g, of g⊥ and of what else acts along a motion.
struct Powers {
  double along = 0, across = 0, rest = 0;
};

Powers powers_of(const Packing& packing, const exact::BodyMotion& motion) {
  const Vector2& g = packing.gravity;
  Loads along, across;
  along.gravity = g;
  across.gravity = {-g.y(), g.x()};
  Loads rest = loads_of(packing);
  rest.gravity.setZero();
  Powers powers{load_power(packing, along, motion), load_power(packing, across, motion),
                load_power(packing, rest, motion)};
  const std::vector<ForceBound> bounds = force_bounds(packing);
  for (Eigen::Index k = 0; k < motion.bounds.size(); ++k)
    powers.rest -= bounds[static_cast<std::size_t>(k)].value * motion.bounds[k];
  return powers;
}

/// One way round, from 0 to its end.
class ArcFinder {
 public:
  ArcFinder(const Packing& packing, int sign, const LimitOptions& options)
      : packing_(packing), sign_(sign), options_(options) {}

  LimitEnd find() {
    const Standing standing = find_standing(packing_, options_);
    if (!standing.stands()) {
      if (standing.falls()) {
        end_.outcome = LimitOutcome::kNoState;
        end_.motion = standing.motion;
      }
      return end_;
    }
    while (tests_ < kMostTests && inside_ < kTurn && !is_enclosed()) advance();
    describe();
    return end_;
  }

 private:
  Vector2 gravity_at(double angle) const { return turned(packing_.gravity, sign_ * angle); }
  bool is_enclosed() const { return outside_ - inside_ <= 2 * tolerance::kTilt; }

  enum class Side : std::uint8_t { kIn, kOut, kUndecided };
  /// On which side of the boundary some gravity is: the set is convex, and it stands at `inside_`. `limit_`
  /// becomes the point of the boundary on the way there.
  Side side_of(const Vector2& gravity) {
    ++tests_;
    Packing here = packing_;
    here.gravity = gravity_at(inside_);
    Loads change;
    change.gravity = gravity - here.gravity;
    limit_ = LoadLimitFinder(here, change, options_).find(1);
    if (limit_.outcome == LimitOutcome::kNever) return Side::kIn;
    if (limit_.outcome != LimitOutcome::kReached) return Side::kUndecided;
    if (limit_.lower >= 1) return Side::kIn;
    return limit_.upper < 1 ? Side::kOut : Side::kUndecided;
  }

  /// Moves `inside_` on by an arc that is in the set, or `outside_` to an angle at which it falls.
  void advance() {
    double angle = std::min(outside_ - 1.5 * tolerance::kTilt, inside_ + kLongestArc);
    while (tests_ < kMostTests) {
      const Side side = side_of(gravity_at(angle));
      if (side == Side::kOut) return leave(angle);
      if (side == Side::kUndecided) break;
      const double half = (angle - inside_) / 2;
      const double length = (1 + 4 * kRoundoff) / std::cos(half);
      if (side_of(length * gravity_at(inside_ + half)) == Side::kIn) {
        inside_ = angle;
        return;
      }
      angle = inside_ + half;
    }
    tests_ = kMostTests;
  }

  /// It falls at `angle`: the mechanism on the way there tells from where on, and that is proven again there.
  void leave(double angle) {
    outside_ = angle;
    boundary_ = limit_;
    const Powers powers = powers_of(packing_, limit_.motion);
    const double across = sign_ * powers.across;
    const double amplitude = std::hypot(powers.along, across);
    if (!(std::abs(powers.rest) <= amplitude)) return;
    const double entry = std::atan2(across, powers.along) - std::acos(-powers.rest / amplitude);
    // Rounding may put a crossing at `inside_` before it.
    const double turns = std::ceil((inside_ - tolerance::kTilt - entry) / kTurn);
    const double beyond = std::max(entry + kTurn * turns, inside_) + tolerance::kTilt;
    if (!(beyond < angle) || side_of(gravity_at(beyond)) != Side::kOut) return;
    outside_ = beyond;
    boundary_ = limit_;
  }

  void describe() {
    if (inside_ >= kTurn) {
      end_.outcome = LimitOutcome::kNever;
      end_.value = end_.lower = end_.upper = sign_ * kInfinity;
      return;
    }
    end_ = boundary_;
    end_.outcome = is_enclosed() ? LimitOutcome::kReached : LimitOutcome::kUndecided;
    const double rounding = 16 * kRoundoff;
    const double inside = inside_ == 0 ? 0 : sign_ * (inside_ - rounding);
    const double outside = sign_ * (outside_ + rounding);
    end_.lower = std::min(inside, outside);
    end_.upper = std::max(inside, outside);
    end_.value = is_enclosed() ? (end_.lower + end_.upper) / 2 : kNaN;
    if (!is_enclosed()) {
      end_.forces = {};
      end_.motion = {};
      end_.sliding = end_.non_transmitting = end_.dim = -1;
      end_.has_one_mechanism = false;
    }
  }

  const Packing& packing_;
  int sign_;
  LimitOptions options_;
  double inside_ = 0;           ///< it stands from 0 to this angle
  double outside_ = kInfinity;  ///< it falls at this one
  LimitEnd limit_;              ///< of the last test
  LimitEnd boundary_;           ///< next to `outside_`
  LimitEnd end_;
  int tests_ = 0;
};

}  // namespace

TiltLimits find_tilt_arc(const Packing& packing, const LimitOptions& options) {
  TiltLimits limits;
  limits.largest = ArcFinder(packing, 1, options).find();
  limits.smallest = ArcFinder(packing, -1, options).find();
  limits.is_first_of_several = true;
  return limits;
}

}  // namespace indet
