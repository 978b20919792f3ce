#include "libindet/verify/limits_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <set>
#include <string>
#include <utility>

#include "libindet/base/constants.h"
#include "libindet/base/rounding_bounds.h"
#include "libindet/base/tolerances.h"
#include "libindet/exact/certificate.h"
#include "libindet/exact/optimum.h"
#include "libindet/limit/friction_limit.h"
#include "libindet/limit/tilt.h"
#include "libindet/verify/comparisons.h"
#include "libindet/verify/rebuilt_problem.h"
#include "libindet/verify/steps_check.h"

namespace indet {
namespace {

/// One end of one limit.
class EndCheck {
 public:
  EndCheck(const Packing& packing, const Limit& limit, bool is_largest, Comparisons& compare)
      : packing_(packing),
        limit_(limit),
        end_(is_largest ? limit.largest : limit.smallest),
        sign_(is_largest ? 1 : -1),
        name_(is_largest ? "largest" : "smallest"),
        compare_(compare) {}

  void check(bool exact) {
    if (end_.outcome != LimitOutcome::kReached)
      compare_.require(
          end_.sliding == -1 && end_.non_transmitting == -1 && end_.dim == -1 && !end_.has_one_mechanism,
          "{}: it is not reached, and yet contacts are counted there", name_);
    switch (end_.outcome) {
      case LimitOutcome::kReached: {
        const bool has_state = check_state();
        const bool has_mechanism = check_mechanism();
        if (exact && has_state && has_mechanism) check_exactly();
        return;
      }
      case LimitOutcome::kNever:
        check_ray();
        return;
      case LimitOutcome::kNoState:
        check_fall();
        return;
      case LimitOutcome::kUndecided:
        compare_.call_unsolved(fmt::format("{} ({})", name_, limit_.name));
        return;
    }
  }

 private:
  /// Forces of the contacts that are left, in units of the problem.
  Eigen::VectorXd forces_of(double unit) const {
    const std::set<int> left_out = left_out_disks();
    std::vector<double> forces;
    for (int i = 0; i < packing_.contact_count(); ++i) {
      const Contact& contact = packing_[ContactId(i)];
      const bool is_out = left_out.contains(contact.a.value()) ||
                          (!contact.b.is_wall() && left_out.contains(contact.b.disk_id().value()));
      for (const int k : {0, 1}) {
        const double force = end_.forces.value()[2 * i + k];
        if (is_out)
          compare_.require(force == 0, "{}: contact {} of a disk that is left out has a force", name_, i);
        else
          forces.push_back(force / unit);
      }
    }
    return Eigen::Map<const Eigen::VectorXd>(forces.data(), static_cast<Eigen::Index>(forces.size()));
  }
  std::set<int> left_out_disks() const {
    std::set<int> disks;
    for (const DiskId disk : limit_.left_out) disks.insert(disk.value());
    return disks;
  }

  bool check_state() {
    compare_.require(end_.lower <= end_.value && end_.value <= end_.upper,
                     "{}: {} is not between its bounds {} and {}", name_, end_.value, end_.lower, end_.upper);
    compare_.require(end_.upper - end_.lower <= tolerance::kLimitWidth * std::max(1.0, std::abs(end_.value)),
                     "{}: its bounds {} and {} are too far apart", name_, end_.lower, end_.upper);
    if (!compare_.require(end_.forces.value().size() == 2 * packing_.contact_count(), "{}: no forces", name_))
      return false;
    const Packing there = packing_at(packing_, limit_, end_.value);
    const RebuiltProblem problem(there);
    const Eigen::VectorXd forces = forces_of(problem.force_unit());
    const double largest = std::max(problem.internal_unit(), forces.lpNorm<Eigen::Infinity>());
    const double worst = compare_.add_state(problem, forces);
    compare_.require(worst <= tolerance::kResistedMotion * largest,
                     "{}: the state there misses balance or friction by {} mg", name_, worst);
    check_counts(problem, forces);
    return true;
  }

  /// Strengths that are 0 exactly are 0 within rounding, too; others that are nearly 0 leave it open.
  void check_counts(const RebuiltProblem& problem, const Eigen::VectorXd& forces) {
    const double unit = problem.internal_unit();
    // The state of a limit of friction is not quite at the limit: there the counts are those of the
    // tolerance.
    bool is_clear = true;
    for (int half_plane = 0; half_plane < 2 * problem.contact_count(); ++half_plane) {
      const double slack = problem.slack(half_plane, forces);
      is_clear =
          is_clear && (slack <= tolerance::kAgreement * unit || slack > 2 * tolerance::kSliding * unit);
    }
    const auto count = problem.count_sliding(forces);
    const bool agrees =
        is_clear || limit_.kind == LimitKind::kFriction
            ? end_.sliding == count.sliding && end_.non_transmitting == count.non_transmitting
            : end_.sliding <= count.sliding && end_.non_transmitting <= count.non_transmitting;
    compare_.require(agrees,
                     "{}: {} sliding and {} non-transmitting contacts are stored, but there are {} and {}",
                     name_, end_.sliding, end_.non_transmitting, count.sliding, count.non_transmitting);
  }

  /// Power of the load along the motion of this end, as Σ of terms.
  RebuiltProblem::Sum power(const Packing& packing) const {
    const RebuiltProblem problem(packing);
    RebuiltProblem::Sum sum = problem.load_product(rows(problem));
    sum.value *= -problem.force_unit();
    sum.size *= problem.force_unit();
    return sum;
  }
  Eigen::VectorXd rows(const RebuiltProblem& problem) const {
    const Eigen::VectorXd motion =
        problem.flat_motion(end_.motion.disks, end_.motion.walls, end_.motion.cell);
    Eigen::VectorXd y = Eigen::VectorXd::Zero(problem.scene_rows());
    y.head(motion.size()) = motion;
    if (end_.motion.bounds.size() > 0) y.tail(end_.motion.bounds.size()) = end_.motion.bounds;
    return y;
  }

  bool check_no_resistance(const Packing& packing) {
    const auto bounds = static_cast<Eigen::Index>(force_bounds(packing).size());
    if (!compare_.require(
            end_.motion.disks.rows() == packing.disk_count() && end_.motion.bounds.size() == bounds,
            "{}: no mechanism", name_))
      return false;
    for (int i = 0; i < packing.disk_count(); ++i)
      compare_.require(!packing[DiskId(i)].fixed || end_.motion.disks.row(i).isZero(0),
                       "{}: disk {} is fixed or left out, but moves", name_, packing[DiskId(i)].id);
    const RebuiltProblem problem(packing);
    const Eigen::VectorXd motion =
        problem.flat_motion(end_.motion.disks, end_.motion.walls, end_.motion.cell);
    const double resisted = problem.smallest_power(motion, end_.motion.bounds);
    return compare_.require(resisted >= -tolerance::kResistedMotion,
                            "{}: some contact resists the mechanism ({})", name_, resisted);
  }

  bool check_mechanism() {
    if (limit_.kind == LimitKind::kFriction) return check_friction();
    const Packing rest = without(packing_, limit_.left_out);
    if (!check_no_resistance(rest)) return false;
    if (limit_.kind == LimitKind::kLoad) {
      const RebuiltProblem::Sum own = power(rest);
      const RebuiltProblem::Sum change = change_power(rest, limit_.change);
      if (!compare_.require(sign_ * change.value > tolerance::kResistedMotion * change.size,
                            "{}: more of the load does no work along the mechanism", name_))
        return false;
      const double error = tolerance::kResistedMotion * (own.size + std::abs(end_.value) * change.size) /
                           std::abs(change.value);
      compare_.require(std::abs(-own.value / change.value - end_.value) <= error,
                       "{}: {} is stored, but by its mechanism it is {}", name_, end_.value,
                       -own.value / change.value);
      return true;
    }
    // Along the mechanism gravity at angle θ has the power p cos θ + q sin θ + r.
    Loads across;
    across.gravity = {-rest.gravity.y(), rest.gravity.x()};
    Loads along;
    along.gravity = rest.gravity;
    const RebuiltProblem::Sum p = change_power(rest, along);
    const RebuiltProblem::Sum q = change_power(rest, across);
    const RebuiltProblem::Sum all = power(rest);
    const double c = std::cos(end_.value);
    const double s = std::sin(end_.value);
    const double there = all.value - p.value + p.value * c + q.value * s;
    const double slope = q.value * c - p.value * s;
    compare_.require(sign_ * slope > 0, "{}: tilted further, gravity does no work along the mechanism",
                     name_);
    compare_.require(std::abs(there) <= tolerance::kResistedMotion * (all.size + p.size + q.size),
                     "{}: at {} rad the load does work along the mechanism ({})", name_, end_.value, there);
    return true;
  }

  /// With the friction just below, the load does work along a motion that nothing resists.
  bool check_friction() {
    if (end_.value == 0 && limit_.is_attained)  // no friction is needed
      return compare_.require(end_.motion.disks.rows() == 0,
                              "{}: no friction is needed, yet there is a motion", name_);
    const Packing there = packing_at(packing_, limit_, end_.lower);
    if (!check_no_resistance(there)) return false;
    const RebuiltProblem::Sum load = power(there);
    return compare_.require(load.value > 0, "{}: the load does no work along the motion ({})", name_,
                            load.value);
  }

  RebuiltProblem::Sum change_power(const Packing& packing, const Loads& change) const {
    Packing alone = under_alone(change, packing);
    for (Contact& contact : alone.contacts)
      contact.R_lo = contact.T_lo = -kInfinity, contact.R_hi = contact.T_hi = kInfinity;
    const RebuiltProblem problem(alone);
    RebuiltProblem::Sum sum;
    const Eigen::VectorXd motion =
        problem.flat_motion(end_.motion.disks, end_.motion.walls, end_.motion.cell);
    for (Eigen::Index i = 0; i < motion.size(); ++i)
      sum.add(problem.wrench()[i] * motion[i] * problem.force_unit());
    return sum;
  }

  /// The ray balances the change of the load alone.
  void check_ray() {
    const double never = sign_ * kInfinity;
    compare_.require(end_.value == never && end_.lower == never && end_.upper == never,
                     "{}: never, yet the value is {}, between {} and {}", name_, end_.value, end_.lower,
                     end_.upper);
    compare_.require(end_.motion.disks.rows() == 0, "{}: never, yet there is a motion", name_);
    if (limit_.kind == LimitKind::kFriction) return;  // larger cones hold the smaller ones
    if (limit_.smallest.outcome == limit_.largest.outcome)
      compare_.leave_unchecked(fmt::format("that any value has a state ({})", limit_.name));
    if (limit_.kind == LimitKind::kTilt) {
      compare_.leave_unchecked(
          fmt::format("{} of {}: that it stands whichever way gravity points", name_, limit_.name));
      return;
    }
    if (!compare_.require(end_.forces.value().size() == 2 * packing_.contact_count(), "{}: no ray", name_))
      return;
    const Packing alone = under_alone(limit_.change, without(packing_, limit_.left_out));
    const RebuiltProblem problem(alone);
    const Eigen::VectorXd ray = forces_of(1);
    // The ray is stored with largest entry 1: its multiple balances the change.
    const Eigen::VectorXd wrench = sign_ * problem.wrench();
    const Eigen::VectorXd balanced = problem.matrix() * ray;
    const double factor = wrench.squaredNorm() > 0 ? -balanced.dot(wrench) / wrench.squaredNorm() : 0;
    const double miss = (balanced + factor * wrench).lpNorm<Eigen::Infinity>();
    compare_.require(factor > 0 && miss <= tolerance::kResistedMotion,
                     "{}: the ray does not balance the load (misses by {})", name_, miss);
    const double violation = problem.ray_violation(ray);
    compare_.require(violation <= tolerance::kResistedMotion, "{}: the ray breaks a contact condition by {}",
                     name_, violation);
  }

  /// No multiple of the load has a state: the motion is not resisted, and the change has no power.
  void check_fall() {
    const bool is_factor = limit_.kind == LimitKind::kFriction && sign_ < 0;
    compare_.require(
        is_factor ? end_.value == kInfinity && end_.upper == kInfinity
                  : std::isnan(end_.value) && end_.lower == -kInfinity && end_.upper == kInfinity,
        "{}: no state, yet the value is {}, between {} and {}", name_, end_.value, end_.lower, end_.upper);
    Packing rest = without(packing_, limit_.left_out);
    if (limit_.kind == LimitKind::kFriction) {
      if (sign_ > 0) return;  // of the smallest one
      // Where it is proven for any friction, equations contradict each other, and no contact moves at all.
      const double factor = std::isinf(end_.lower) ? 0x1p60 : end_.lower;
      rest = with_friction(std::move(rest), limit_.scaled, factor);
    }
    if (!check_no_resistance(rest)) return;
    const RebuiltProblem::Sum own = power(rest);
    compare_.require(own.value > 0, "{}: the load does no work along the motion ({})", name_, own.value);
    if (limit_.kind == LimitKind::kTilt) {
      compare_.leave_unchecked(fmt::format("that no other angle has a state ({})", limit_.name));
      return;
    }
    if (limit_.kind == LimitKind::kFriction) return;
    const RebuiltProblem::Sum change = change_power(rest, limit_.change);
    compare_.require(std::abs(change.value) <= tolerance::kResistedMotion * change.size,
                     "{}: the change of the load has the power {} along the motion", name_, change.value);
  }

  void check_exactly() {
    if (limit_.smallest.value == limit_.largest.value)
      return compare_.leave_unchecked(
          fmt::format("{}: by exact arithmetic (it stands at one value alone)", limit_.name));
    // The load there is rounded in each of its numbers.
    const double step = 16 * kRoundoff * rounded_size();
    const double inside = (sign_ > 0 ? end_.lower : end_.upper) - sign_ * step;
    const double outside = (sign_ > 0 ? end_.upper : end_.lower) + sign_ * step;
    compare_.require(stands(packing_at(packing_, limit_, inside)),
                     "{}: exact arithmetic finds no state at {}", name_, inside);
    if (limit_.kind == LimitKind::kFriction && end_.upper == 0) return;
    const Packing beyond = packing_at(packing_, limit_, outside);
    const exact::ContactProblem problem(beyond);
    compare_.require(
        exact::proves_emptiness(problem, exact::on_rows(beyond, problem, end_.motion), tolerance::kExactZero),
        "{}: exact arithmetic does not prove that it falls at {}", name_, outside);
  }

  /// A change of the value by a rounding of this is one of the load by a rounding of its largest part.
  double rounded_size() const {
    if (limit_.kind == LimitKind::kFriction) return 0;
    if (limit_.kind == LimitKind::kTilt) return std::max(1.0, std::abs(end_.value));
    const Packing rest = without(packing_, limit_.left_out);
    const RebuiltProblem own(rest);
    const Packing alone = under_alone(limit_.change, rest);
    const RebuiltProblem change(alone);
    const double largest_own = own.wrench().lpNorm<Eigen::Infinity>() * own.force_unit();
    const double largest_change = change.wrench().lpNorm<Eigen::Infinity>() * change.force_unit();
    return std::abs(end_.value) + (largest_own > 0 ? largest_own / largest_change : 1);
  }

  bool stands(const Packing& packing) const {
    const exact::ContactProblem problem(packing);
    const Eigen::VectorXd forces = forces_of(1);
    const std::vector<double> strengths =
        exact::edge_strengths(packing, {forces.data(), static_cast<std::size_t>(forces.size())});
    const std::shared_ptr<const exact::ContactBasis> start =
        exact::ContactBasis::create(problem, problem.choose_basis(strengths));
    constexpr int kMostPivots = 100;
    return start && exact::find_solution(problem, start, kMostPivots).verdict == exact::Verdict::kOptimal;
  }

  const Packing& packing_;
  const Limit& limit_;
  const LimitEnd& end_;
  int sign_;
  std::string name_;
  Comparisons& compare_;
};

/// Both ends are the same, as far as is proven.
bool is_one_value(const Limit& limit) {
  return limit.largest.outcome == LimitOutcome::kReached && limit.largest.lower <= limit.smallest.upper;
}

/// Angles of an interval about 0 are at most a whole turn from it, and those of a cone half a turn apart.
void check_angles(const Limit& limit, Comparisons& compare) {
  constexpr double kTurn = 2 * std::numbers::pi;
  for (const LimitEnd* end : {&limit.smallest, &limit.largest}) {
    compare.require(!(std::abs(end->value) > kTurn + tolerance::kAgreement) || std::isinf(end->value),
                    "{}: {} rad is more than a turn", limit.name, end->value);
  }
  const double width = limit.largest.value - limit.smallest.value;
  compare.require(
      limit.is_first_of_several || !std::isfinite(width) || width <= kTurn / 2 + tolerance::kAgreement,
      "{}: {} rad from end to end is more than half a turn", limit.name, width);
  if (limit.is_first_of_several)
    compare.leave_unchecked(fmt::format("that it stands at all angles from end to end ({})", limit.name));
}

/// Of steps all but the values where they are.
std::string describe_steps() {
  std::string names;
  for (const StepField<int>& field : kStepCounts) names += std::string(field.name) + ", ";
  for (const StepField<double>& field : kStepNumbers) names += std::string(field.name) + ", ";
  return names + "of steps on the way to limits (held against each other alone)";
}

}  // namespace

Verification verify_limits(const Packing& packing, const std::vector<Limit>& limits, bool exact) {
  Comparisons compare("/limits");
  bool has_steps = false;
  for (const Limit& limit : limits) {
    compare.require((limit.smallest.outcome == LimitOutcome::kNoState) ==
                        (limit.largest.outcome == LimitOutcome::kNoState),
                    "{}: one end says that there is no state, the other one does not", limit.name);
    compare.require(!(limit.smallest.lower > limit.largest.upper), "{}: the ends are in the wrong order",
                    limit.name);
    const bool turns = limit.kind != LimitKind::kTilt ||
                       (is_under_gravity_alone(without(packing, limit.left_out)) && !is_one_value(limit));
    if (limit.kind == LimitKind::kTilt) check_angles(limit, compare);
    if (!compare.require(limit.kind == LimitKind::kTilt || limit.left_out.empty(),
                         "{}: left_out is for tilts alone", limit.name))
      continue;
    compare.require(limit.is_first_of_several == !turns, "{}: first_of_several is {}", limit.name,
                    limit.is_first_of_several);
    for (const bool is_largest : {false, true}) {
      EndCheck(packing, limit, is_largest, compare).check(exact);
      const LimitEnd& end = is_largest ? limit.largest : limit.smallest;
      has_steps = has_steps || !end.steps.empty();
      check_steps(packing, limit, end, fmt::format("{} {}", limit.name, is_largest ? "largest" : "smallest"),
                  turns && limit.kind == LimitKind::kTilt, compare);
    }
  }
  std::string unchecked =
      "dim and one_mechanism of limits, attained of limits of friction, map_angle of loads";
  if (!exact) unchecked += ", and the last digits of bounds (--exact proves these)";
  compare.leave_unchecked(std::move(unchecked));
  if (has_steps) compare.leave_unchecked(describe_steps());
  return compare.result();
}

}  // namespace indet
