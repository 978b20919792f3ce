#include "libindet/verify/verify.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "libindet/base/constants.h"
#include "libindet/base/error.h"
#include "libindet/base/tolerances.h"
#include "libindet/exact/contact_problem.h"
#include "libindet/range/promise.h"
#include "libindet/verify/comparisons.h"
#include "libindet/verify/distances_check.h"
#include "libindet/verify/draws_check.h"
#include "libindet/verify/duals_check.h"
#include "libindet/verify/enclosed_check.h"
#include "libindet/verify/estimate_check.h"
#include "libindet/verify/exact_answers.h"
#include "libindet/verify/hull_check.h"
#include "libindet/verify/kept_states_check.h"
#include "libindet/verify/motion_check.h"
#include "libindet/verify/needed_equations.h"
#include "libindet/verify/outcome_check.h"
#include "libindet/verify/predictions_check.h"
#include "libindet/verify/reactions_check.h"
#include "libindet/verify/rebuilt_problem.h"
#include "libindet/verify/sensitivity_check.h"
#include "libindet/verify/sparse_optimality.h"

namespace indet {
namespace {

class Verifier {
 public:
  Verifier(const Packing& packing, const ForceRanges& ranges, const ProgressCallback& progress)
      : packing_(packing),
        ranges_(ranges),
        progress_(progress),
        problem_(packing),
        exact_(packing, ranges),
        loads_(loads_at_contacts(packing)) {}

  Verification run() {
    check_problem();
    check_kept_states(ranges_, compare_);
    if (ranges_.status == PolytopeStatus::kEmpty) check_motion(packing_, ranges_, problem_, exact_, compare_);
    check_states();
    check_rays();
    check_objectives();
    check_measures();
    check_counts();
    check_enclosed(packing_, ranges_, progress_, compare_);
    if (ranges_.duals.are_kept()) check_duals(ranges_, problem_, compare_);
    check_smallest_distances(packing_, ranges_, problem_, compare_);
    if (ranges_.exact && ranges_.status != PolytopeStatus::kEmpty) {
      exact_.check_structure(compare_);
      check_equal_ends();
    } else {
      check_hull(packing_, ranges_, problem_, compare_);
    }
    name_the_rest();
    check_reactions(packing_, ranges_, problem_, exact_, compare_);
    return compare_.result();
  }

 private:
  void check_problem() {
    compare_.equal(ranges_.force_unit, problem_.force_unit(), "force_unit");
    check_nullity();
    compare_.equal_count(ranges_.rank + ranges_.nullity, ranges_.unknowns, "rank + nullity");
    std::int64_t unknowns = 0;
    for (const Contact& contact : packing_.contacts) unknowns += contact.mu > 0 ? 2 : 1;
    unknowns += problem_.half_planes() - 2 * packing_.contact_count();  // slacks
    compare_.equal_count(ranges_.unknowns, unknowns, "unknowns");
    compare_.equal_count(ranges_.equations, needed_equations(packing_), "equations");
    compare_.require(ranges_.dim <= ranges_.nullity, "dim: {} is larger than the nullity {}", ranges_.dim,
                     ranges_.nullity);
    check_status(ranges_, compare_);
    if (ranges_.status != PolytopeStatus::kEmpty) {
      compare_.require(ranges_.active.cols() == ranges_.dim, "active: {} half-planes a state, but dim is {}",
                       ranges_.active.cols(), ranges_.dim);
    }
  }

  /// Values that are the same in every state have the same bounds. That others have, too, is rounding.
  void check_equal_ends() {
    std::int64_t same = 0;
    for (Eigen::Index i = 0; i < ranges_.outcome.rows(); ++i) {
      for (const int minimum : {kMinR, kMinT}) {
        const bool is_same = ranges_.lower(i, minimum) == ranges_.lower(i, minimum + 1) &&
                             ranges_.upper(i, minimum) == ranges_.upper(i, minimum + 1);
        same += is_same ? 2 : 0;
      }
    }
    compare_.require(ranges_.determined >= 0 && ranges_.determined <= same,
                     "determined: {} is stored, at most {} is right", ranges_.determined, same);
  }

  void check_nullity() {
    if (ranges_.exact) {
      // Rounding may hide the rank, and double precision then sees another one.
      compare_.equal_count(ranges_.rank, exact::ContactProblem(packing_).rank(), "rank");
      return;
    }
    if (ranges_.unknowns <= tolerance::kMostForPrograms) {
      compare_.equal_count(ranges_.nullity, problem_.nullity(), "nullity");
      return;
    }
    // Singular values that the analysis counted have to be clear of those that count as 0 here.
    const bool is_clear = ranges_.smallest_accepted > 10 * tolerance::kSparseRank;
    const auto nullity = is_clear ? problem_.nullity_by_inertia(tolerance::kSparseRank) : std::nullopt;
    if (nullity)
      compare_.equal_count(ranges_.nullity, *nullity, "nullity");
    else
      compare_.leave_unchecked("nullity (a singular value is near to 0, and the packing is large)");
  }

  Eigen::VectorXd state(Eigen::Index k) const {
    return ranges_.states.row(k).transpose() / ranges_.force_unit;
  }

  void check_states() {
    for (Eigen::Index k = 0; k < ranges_.states.rows(); ++k) {
      const Eigen::VectorXd forces = state(k);
      const double scale =
          std::max(problem_.internal_unit(), forces.size() > 0 ? forces.lpNorm<Eigen::Infinity>() : 0.0);
      largest_scale_ = std::max(largest_scale_, scale);
      residuals_.push_back(compare_.add_state(problem_, forces) / scale);
      compare_.require(std::isfinite(residuals_.back()), "state {}: not a number", k);
      compare_.equal(ranges_.norm[k], ranges_.states.row(k).norm(), fmt::format("norm of state {}", k));
      std::vector<int> tight;
      for (int h = 0; h < problem_.half_planes(); ++h) {
        if (problem_.slack(h, forces) <= tolerance::kTightHalfPlane * scale) tight.push_back(h);
      }
      for (const int h : ranges_.active.row(k)) {
        compare_.require(std::binary_search(tight.begin(), tight.end(), h),
                         "state {}: half-plane {} is not active, its slack is {}", k, h,
                         problem_.slack(h, forces));
      }
      tight_.push_back(std::move(tight));
    }
    const double imbalance = residuals_.empty() ? 0 : compare_.result().worst_imbalance;
    const double rounding =
        tolerance::kAgreement * std::max({problem_.internal_unit(), imbalance, largest_scale_});
    const bool keeps_all =
        ranges_.state_kind != StateChoice::Kind::kNone && ranges_.states_of == StateChoice::Contacts::kAll;
    compare_.require(
        ranges_.residual >= imbalance - rounding && (!keeps_all || ranges_.residual <= imbalance + rounding),
        "residual: {} is stored, {} is right", ranges_.residual, imbalance);
    if (ranges_.norm.size() > 0) {
      Eigen::Index largest = 0;
      ranges_.norm.maxCoeff(&largest);
      compare_.require(
          ranges_.largest_norm >= 0 && ranges_.norm[ranges_.largest_norm] == ranges_.norm[largest],
          "largest_norm: state {} is stored, state {} is right", ranges_.largest_norm, largest);
    }
  }

  void check_rays() {
    for (Eigen::Index q = 0; q < ranges_.rays.rows(); ++q) {
      const Eigen::VectorXd ray = ranges_.rays.row(q).transpose();
      compare_.require(problem_.imbalance_without_load(ray) <= tolerance::kStoredRay,
                       "ray {}: it is not in the null space ({})", q, problem_.imbalance_without_load(ray));
      compare_.require(problem_.ray_violation(ray) <= tolerance::kStoredRay,
                       "ray {}: it violates the contact conditions ({})", q, problem_.ray_violation(ray));
    }
  }

  void check_objectives() {
    for (int i = 0; i < packing_.contact_count(); ++i) {
      for (int column = 0; column < 4; ++column) check_objective(i, column);
      if (progress_ && !progress_({"verify", i + 1, packing_.contact_count(), {}})) throw Interrupted();
    }
  }

  void check_objective(int contact, int column) {
    const std::string place = fmt::format("contact {} {}", contact, to_string(static_cast<Column>(column)));
    const Outcome outcome = ranges_.outcome(contact, column);
    const double value = ranges_.value(contact, column);
    const int component = 2 * contact + (column >= kMinT ? 1 : 0);
    const double sign = column == kMaxR || column == kMaxT ? 1 : -1;
    const int vertex = ranges_.vertex(contact, column);
    compare_.require(std::isnan(value) ||
                         (ranges_.lower(contact, column) <= value && value <= ranges_.upper(contact, column)),
                     "{}: the value {} is not within its bounds", place, value);
    check_sensitivity(ranges_, contact, column, place, compare_);
    if (std::isinf(value)) {
      const int ray = ranges_.ray(contact, column);
      compare_.require(value == sign * std::abs(value), "{}: wrong sign of infinity", place);
      if (compare_.require(ray >= 0 && ray < ranges_.rays.rows(), "{}: no ray shows that it is unbounded",
                           place)) {
        compare_.require(sign * ranges_.rays(ray, component) > 0, "{}: it does not grow along ray {}", place,
                         ray);
      }
      return;
    }
    if (outcome == Outcome::kFailed || is_left_out(outcome)) {
      compare_.require(std::isnan(value) && vertex < 0, "{}: {}, but a value is stored", place,
                       to_string(outcome));
      return;
    }
    if (vertex < 0 && ranges_.method == Method::kBarrier) return;  // enclosed_check.h
    if (vertex < 0) {
      ++stateless_;
      check_without_state(ranges_, contact, column, place, compare_);
      return;
    }
    if (!compare_.require(vertex < ranges_.states.rows(), "{}: there is no state {}", place, vertex)) return;
    compare_.require(ranges_.states(vertex, component) == value,
                     "{}: the value {} differs from its state's {}", place, value,
                     ranges_.states(vertex, component));
    const auto k = static_cast<std::size_t>(vertex);
    const double primal = ranges_.primal_residual(contact, column);
    compare_.require(std::abs(primal - residuals_[k]) <= tolerance::kAgreement,
                     "{}: primal residual {} is stored, {} is right", place, primal, residuals_[k]);
    if (outcome != Outcome::kOptimal) return;
    compare_.require(residuals_[k] <= tolerance::kPrimalResidual,
                     "{}: its state violates equilibrium or contact conditions by {}", place, residuals_[k]);
    compare_.require(ranges_.dual_residual(contact, column) <= tolerance::kDualResidual,
                     "{}: dual residual {} of a certified value", place,
                     ranges_.dual_residual(contact, column));
    check_width(contact, column, place);
    if (ranges_.exact) {
      const double next = std::nextafter(ranges_.lower(contact, column), kInfinity);
      compare_.require(ranges_.upper(contact, column) <= next,
                       "{}: exact, but its bounds are no neighbouring doubles", place);
    }
    const double gap = optimality_gap(component, sign, vertex);
    if (gap > allowed_gap() && exact_.agree_on_value(contact, column)) return;
    compare_.add_optimum(gap);
    compare_.require(gap <= allowed_gap(), "{}: the value {} is not optimal (gap {})", place, value, gap);
  }

  void check_width(int contact, int column, const std::string& place) {
    const double width = ranges_.upper(contact, column) - ranges_.lower(contact, column);
    const double allowed = promised_width(ranges_.value(contact, column), loads_[contact]);
    compare_.require(width <= allowed * (1 + tolerance::kAgreement),
                     "{}: certified, but its bounds are {} apart, more than {}", place, width, allowed);
  }

  bool is_large() const { return ranges_.unknowns > tolerance::kMostForPrograms; }
  double allowed_gap() const {
    return is_large() ? tolerance::kSparseOptimalityGap : tolerance::kOptimalityGap;
  }

  double optimality_gap(int component, double sign, int vertex) const {
    std::vector<int> active(ranges_.active.row(vertex).begin(), ranges_.active.row(vertex).end());
    if (is_large()) return sparse_optimality_gap(problem_, component, sign, active);
    const double gap = problem_.optimality_gap(component, sign, active);
    if (gap <= tolerance::kOptimalityGap) return gap;
    return problem_.optimality_gap(component, sign, tight_[static_cast<std::size_t>(vertex)]);
  }

  double distance(int first, int second) const {
    if (first < 0 || second < 0) return ForceRanges::kNaN;
    return (ranges_.states.row(first) - ranges_.states.row(second)).norm() / ranges_.force_unit;
  }

  static double place_in_range(double simulated, double low, double high, double internal_unit) {
    if (!std::isfinite(high - low) || !(high - low > tolerance::kPointRange * internal_unit))
      return ForceRanges::kNaN;
    return (simulated - low) / (high - low);
  }

  void check_measures() {
    const double unit = ranges_.force_unit;
    const double internal_unit = unit * problem_.internal_unit();
    for (int i = 0; i < packing_.contact_count(); ++i) {
      const auto value = ranges_.value.row(i);
      const auto vertex = ranges_.vertex.row(i);
      const auto at = [i](const char* name) { return fmt::format("{} of contact {}", name, i); };
      compare_.equal(ranges_.delta_R[i], (value[kMaxR] - value[kMinR]) / unit, at("delta_R"));
      compare_.equal(ranges_.delta_T[i], (value[kMaxT] - value[kMinT]) / unit, at("delta_T"));
      compare_.equal(ranges_.d_R[i], distance(vertex[kMaxR], vertex[kMinR]), at("d_R"));
      compare_.equal(ranges_.d_T[i], distance(vertex[kMaxT], vertex[kMinT]), at("d_T"));
      const Contact& contact = packing_[ContactId(i)];
      compare_.equal(ranges_.R_star[i], place_in_range(contact.R, value[kMinR], value[kMaxR], internal_unit),
                     at("R_star"));
      compare_.equal(ranges_.T_star[i], place_in_range(contact.T, value[kMinT], value[kMaxT], internal_unit),
                     at("T_star"));
    }
  }

  void check_counts() {
    std::int64_t counts[7] = {};
    for (const Outcome outcome : ranges_.outcome.reshaped()) ++counts[static_cast<int>(outcome)];
    const bool all = ranges_.status == PolytopeStatus::kEmpty || ranges_.calibration >= 0;
    const std::int64_t sought = all ? packing_.contact_count() : ranges_.requested;
    compare_.equal_count(ranges_.objectives, 4 * sought - counts[static_cast<int>(Outcome::kEstimate)],
                         "objectives");
    compare_.equal_count(ranges_.unbounded, counts[static_cast<int>(Outcome::kUnbounded)], "unbounded");
    compare_.equal_count(ranges_.enclosed, counts[static_cast<int>(Outcome::kEnclosed)], "enclosed");
    const auto certain = counts[static_cast<int>(Outcome::kOptimal)] + ranges_.unbounded + ranges_.enclosed;
    compare_.equal_count(ranges_.certified, certain, "certified");
    compare_.equal_count(ranges_.imprecise, counts[static_cast<int>(Outcome::kImprecise)], "imprecise");
    compare_.equal_count(ranges_.failed, counts[static_cast<int>(Outcome::kFailed)], "failed");
    compare_.require(
        !ranges_.exact || ranges_.imprecise + ranges_.failed + ranges_.reactions.uncertain() == 0,
        "exact: yet some results are uncertain");
    const auto also = ranges_.reactions.certified();
    compare_.require(!ranges_.doubtful || certain + also == 0,
                     "doubtful: yet {} objectives and {} ends of reactions are certified", certain, also);
    check_worst_residuals();
    check_sliding();
    check_choice();
  }

  void check_worst_residuals() {
    double primal = 0;
    double dual = 0;
    for (Eigen::Index i = 0; i < ranges_.outcome.rows(); ++i) {
      for (int column = 0; column < 4; ++column) {
        const Outcome outcome = ranges_.outcome(i, column);
        if (outcome == Outcome::kFailed || is_left_out(outcome)) continue;
        primal = std::fmax(primal, ranges_.primal_residual(i, column));
        dual = std::fmax(dual, ranges_.dual_residual(i, column));
      }
    }
    compare_.equal(ranges_.worst_primal_residual, primal, "worst_primal_residual", tolerance::kAgreement, 0);
    compare_.equal(ranges_.worst_dual_residual, dual, "worst_dual_residual", tolerance::kAgreement, 0);
  }

  void check_choice() {
    if (ranges_.status == PolytopeStatus::kEmpty) return;
    if (ranges_.calibration >= 0) return check_predictions(packing_, ranges_, problem_, compare_);
    if ((ranges_.outcome == Outcome::kEstimate).any())
      compare_.require(false, "outcome: estimate, but there are none");
    std::vector<double> delta_R;
    std::vector<double> delta_T;
    for (Eigen::Index i = 0; i < ranges_.outcome.rows(); ++i) {
      const auto left_out = (ranges_.outcome.row(i) == Outcome::kNotRequested).count();
      compare_.require(left_out == 0 || left_out == 4,
                       "contact {}: only some of its objectives were left out", i);
      if (left_out > 0) continue;
      delta_R.push_back(ranges_.delta_R[i]);
      delta_T.push_back(ranges_.delta_T[i]);
    }
    compare_.equal_count(ranges_.requested, static_cast<std::int64_t>(delta_R.size()), "requested");
    if (ranges_.choice != ContactChoice::Kind::kSample) return;
    compare_.require(ranges_.sample_seed >= 0, "sample_seed: {} is stored", ranges_.sample_seed);
    if (ranges_.draws > 0) return check_draws(packing_, ranges_, problem_, compare_);
    check_estimate(ranges_.sample_R, delta_R, packing_.contact_count(), "delta_R", compare_);
    check_estimate(ranges_.sample_T, delta_T, packing_.contact_count(), "delta_T", compare_);
  }

  void check_sliding() {
    if (!packing_.has_simulated_forces()) {
      compare_.equal_count(ranges_.sliding, -1, "sliding");
      return;
    }
    const auto [sliding, idle] =
        problem_.count_sliding(packing_.simulated_forces().value() / ranges_.force_unit);
    compare_.equal_count(ranges_.sliding, sliding, "sliding");
    compare_.equal_count(ranges_.non_transmitting, idle, "non_transmitting");
  }

  void name_the_rest() {
    if (ranges_.imprecise > 0)
      compare_.call_unsolved(
          fmt::format("{} of {} objectives imprecise", ranges_.imprecise, ranges_.objectives));
    if (ranges_.failed > 0)
      compare_.call_unsolved(fmt::format("{} of {} objectives failed", ranges_.failed, ranges_.objectives));
    if (ranges_.status == PolytopeStatus::kEmpty && ranges_.doubtful)
      compare_.call_unsolved("that no contact forces are admissible is in doubt");
    compare_.leave_unchecked(
        "rank_gap, smallest_accepted, largest_rejected, rank_ambiguous, doubtful of /equilibrium (they "
        "belong to the factorisation of the analysis)");
    if (!std::isnan(ranges_.hairline))
      compare_.leave_unchecked("hairline of /equilibrium (it is an estimate)");
    if (ranges_.choice == ContactChoice::Kind::kSample && ranges_.draws == 0)
      compare_.leave_unchecked("sample_seed (contacts are not drawn again)");
    if (ranges_.status == PolytopeStatus::kEmpty) return;
    if (stateless_ > 0) {
      compare_.leave_unchecked(
          fmt::format("that {} of {} values are attained and optimal, their primal_residual and residual "
                      "(their states are not in the file; indet analyze … --extremal-states canonical stores "
                      "them)",
                      stateless_, ranges_.objectives));
    }
    if (problem_.narrowest_interval() <= 2 * tolerance::kTightHalfPlane * largest_scale_) {
      compare_.leave_unchecked(
          "that values are optimal, as far as bounds of a force are so close that both seem to be reached "
          "(--exact checks it)");
    }
    compare_.leave_unchecked(ranges_.duals.are_kept()
                                 ? "lower, upper of contacts without multipliers, unique, sensitivity, "
                                   "sensitivity_claim, dual_residual of /ranges "
                                   "(--exact checks lower and upper)"
                                 : "lower, upper, unique, sensitivity, sensitivity_claim, dual_residual of "
                                   "/ranges (multipliers of the linear "
                                   "programs "
                                   "are not stored; --exact checks lower and upper)");
  }

  const Packing& packing_;
  const ForceRanges& ranges_;
  const ProgressCallback& progress_;
  RebuiltProblem problem_;
  ExactAnswers exact_;
  Eigen::VectorXd loads_;  ///< at each contact (range/promise.h)
  Comparisons compare_;
  double largest_scale_ = 0;             ///< of the states' residuals
  std::int64_t stateless_ = 0;           ///< finite values without a state
  std::vector<double> residuals_;        ///< a state
  std::vector<std::vector<int>> tight_;  ///< a state: half-planes without slack
};

}  // namespace

Verification verify_ranges(const Packing& packing, const ForceRanges& ranges,
                           const ProgressCallback& progress) {
  return Verifier(packing, ranges, progress).run();
}

}  // namespace indet
