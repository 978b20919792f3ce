#include "libindet/verify/verify.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

#include "libindet/base/error.h"
#include "libindet/base/tolerances.h"
#include "libindet/verify/oracle.h"

namespace indet {
namespace {

class Verifier {
 public:
  Verifier(const Packing& packing, const ForceRanges& ranges, const ProgressCallback& progress)
      : packing_(packing), ranges_(ranges), progress_(progress), oracle_(packing) {}

  Verification run() {
    check_problem();
    if (ranges_.status == PolytopeStatus::kEmpty) {
      check_motion();
    } else {
      check_states();
      check_rays();
      check_objectives();
      check_measures();
    }
    check_counts();
    return std::move(report_);
  }

 private:
  template <class... Parts>
  bool require(bool holds, fmt::format_string<Parts...> text, Parts&&... parts) {
    ++report_.checks;
    if (holds) return true;
    ++report_.contradictions;
    constexpr std::size_t kShown = 20;
    if (report_.messages.size() < kShown)
      report_.messages.push_back(fmt::format(text, std::forward<Parts>(parts)...));
    return false;
  }

  void equal(double stored, double expected, const std::string& place) {
    const bool same =
        stored == expected || (std::isnan(stored) && std::isnan(expected)) ||
        std::abs(stored - expected) <= tolerance::kAgreement * std::max(1.0, std::abs(expected));
    require(same, "{}: {} is stored, {} is right", place, stored, expected);
  }

  void equal_count(std::int64_t stored, std::int64_t expected, const char* name) {
    require(stored == expected, "{}: {} is stored, {} is right", name, stored, expected);
  }

  void check_problem() {
    equal(ranges_.force_unit, oracle_.force_unit(), "force_unit");
    equal_count(ranges_.nullity, oracle_.nullity(), "nullity");
    equal_count(ranges_.rank + ranges_.nullity, ranges_.unknowns, "rank + nullity");
    std::int64_t unknowns = 0;
    for (const Contact& contact : packing_.contacts) unknowns += contact.mu > 0 ? 2 : 1;
    equal_count(ranges_.unknowns, unknowns, "unknowns");
    require(ranges_.dim <= ranges_.nullity, "dim: {} is larger than the nullity {}", ranges_.dim,
            ranges_.nullity);
    const bool is_point = ranges_.status == PolytopeStatus::kPoint;
    require(is_point == (ranges_.dim == 0), "status {} and dim {} contradict each other",
            to_string(ranges_.status), ranges_.dim);
    if (ranges_.status != PolytopeStatus::kEmpty) {
      require(ranges_.active.cols() == ranges_.dim, "active: {} half-planes a state, but dim is {}",
              ranges_.active.cols(), ranges_.dim);
    }
  }

  void check_motion() {
    if (!require(ranges_.motion.rows() == packing_.disk_count(), "motion: {} rows for {} disks",
                 ranges_.motion.rows(), packing_.disk_count())) {
      return;
    }
    const double power = oracle_.load_power(ranges_.motion);
    const double resisted = oracle_.smallest_contact_power(ranges_.motion);
    require(power > 0, "motion: the load does no work ({})", power);
    require(resisted >= -tolerance::kResistedMotion, "motion: some contact resists it ({})", resisted);
  }

  Eigen::VectorXd state(Eigen::Index k) const {
    return ranges_.states.row(k).transpose() / ranges_.force_unit;
  }

  void check_states() {
    double imbalance = 0;
    for (Eigen::Index k = 0; k < ranges_.states.rows(); ++k) {
      const Eigen::VectorXd forces = state(k);
      const double scale = std::max(packing_.internal_force_unit() / ranges_.force_unit,
                                    forces.size() > 0 ? forces.lpNorm<Eigen::Infinity>() : 0.0);
      residuals_.push_back(oracle_.imbalance(forces));
      imbalance = std::max(imbalance, residuals_.back());
      const double violation = oracle_.violation(forces);
      report_.worst_violation = std::max(report_.worst_violation, violation);
      residuals_.back() = std::max(residuals_.back(), violation) / scale;
      require(std::isfinite(residuals_.back()), "state {}: not a number", k);
      equal(ranges_.norm[k], ranges_.states.row(k).norm(), fmt::format("norm of state {}", k));
      std::vector<int> tight;
      for (int h = 0; h < 2 * packing_.contact_count(); ++h) {
        if (oracle_.slack(h, forces) <= tolerance::kTightHalfPlane * scale) tight.push_back(h);
      }
      for (const int h : ranges_.active.row(k)) {
        require(std::binary_search(tight.begin(), tight.end(), h),
                "state {}: half-plane {} is not active, its slack is {}", k, h, oracle_.slack(h, forces));
      }
      tight_.push_back(std::move(tight));
    }
    report_.worst_imbalance = imbalance;
    require(std::abs(ranges_.residual - imbalance) <= tolerance::kAgreement * std::max(1.0, imbalance),
            "residual: {} is stored, {} is right", ranges_.residual, imbalance);
    if (ranges_.norm.size() > 0) {
      Eigen::Index largest = 0;
      ranges_.norm.maxCoeff(&largest);
      require(ranges_.largest_norm >= 0 && ranges_.norm[ranges_.largest_norm] == ranges_.norm[largest],
              "largest_norm: state {} is stored, state {} is right", ranges_.largest_norm, largest);
    }
  }

  void check_rays() {
    for (Eigen::Index q = 0; q < ranges_.rays.rows(); ++q) {
      const Eigen::VectorXd ray = ranges_.rays.row(q).transpose();
      require(oracle_.imbalance_without_load(ray) <= tolerance::kStoredRay,
              "ray {}: it is not in the null space ({})", q, oracle_.imbalance_without_load(ray));
      require(oracle_.violation(ray) <= tolerance::kStoredRay,
              "ray {}: it violates the contact conditions ({})", q, oracle_.violation(ray));
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
    require(std::isnan(value) ||
                (ranges_.lower(contact, column) <= value && value <= ranges_.upper(contact, column)),
            "{}: the value {} is not within its bounds", place, value);
    if (std::isinf(value)) {
      const int ray = ranges_.ray(contact, column);
      require(value == sign * std::abs(value), "{}: wrong sign of infinity", place);
      if (require(ray >= 0 && ray < ranges_.rays.rows(), "{}: no ray shows that it is unbounded", place)) {
        require(sign * ranges_.rays(ray, component) > 0, "{}: it does not grow along ray {}", place, ray);
      }
      return;
    }
    if (outcome == Outcome::kFailed || outcome == Outcome::kNotRequested) {
      require(std::isnan(value) && vertex < 0, "{}: {}, but a value is stored", place, to_string(outcome));
      return;
    }
    if (!require(vertex >= 0 && vertex < ranges_.states.rows(), "{}: there is no state {}", place, vertex))
      return;
    require(ranges_.states(vertex, component) == value, "{}: the value {} differs from its state's {}", place,
            value, ranges_.states(vertex, component));
    const auto k = static_cast<std::size_t>(vertex);
    const double primal = ranges_.primal_residual(contact, column);
    require(std::abs(primal - residuals_[k]) <= tolerance::kAgreement,
            "{}: primal residual {} is stored, {} is right", place, primal, residuals_[k]);
    if (outcome != Outcome::kOptimal) return;
    require(residuals_[k] <= tolerance::kPrimalResidual,
            "{}: its state violates equilibrium or contact conditions by {}", place, residuals_[k]);
    require(ranges_.dual_residual(contact, column) <= tolerance::kDualResidual,
            "{}: dual residual {} of a certified value", place, ranges_.dual_residual(contact, column));
    std::vector<int> active(ranges_.active.row(vertex).begin(), ranges_.active.row(vertex).end());
    double gap = oracle_.optimality_gap(component, sign, active);
    if (gap > tolerance::kOptimalityGap) gap = oracle_.optimality_gap(component, sign, tight_[k]);
    report_.worst_optimality_gap = std::max(report_.worst_optimality_gap, gap);
    require(gap <= tolerance::kOptimalityGap, "{}: the value {} is not optimal (gap {})", place, value, gap);
  }

  double distance(int first, int second) const {
    if (first < 0 || second < 0) return ForceRanges::kNaN;
    return (ranges_.states.row(first) - ranges_.states.row(second)).norm() / ranges_.force_unit;
  }

  static double place_in_range(double simulated, double low, double high, double unit) {
    if (!std::isfinite(high - low) || !(high - low > tolerance::kPointRange * unit)) return ForceRanges::kNaN;
    return (simulated - low) / (high - low);
  }

  void check_measures() {
    const double unit = ranges_.force_unit;
    for (int i = 0; i < packing_.contact_count(); ++i) {
      const auto value = ranges_.value.row(i);
      const auto vertex = ranges_.vertex.row(i);
      const auto at = [i](const char* name) { return fmt::format("{} of contact {}", name, i); };
      equal(ranges_.delta_R[i], (value[kMaxR] - value[kMinR]) / unit, at("delta_R"));
      equal(ranges_.delta_T[i], (value[kMaxT] - value[kMinT]) / unit, at("delta_T"));
      equal(ranges_.d_R[i], distance(vertex[kMaxR], vertex[kMinR]), at("d_R"));
      equal(ranges_.d_T[i], distance(vertex[kMaxT], vertex[kMinT]), at("d_T"));
      const Contact& contact = packing_[ContactId(i)];
      equal(ranges_.R_star[i], place_in_range(contact.R, value[kMinR], value[kMaxR], unit), at("R_star"));
      equal(ranges_.T_star[i], place_in_range(contact.T, value[kMinT], value[kMaxT], unit), at("T_star"));
    }
  }

  void check_counts() {
    std::int64_t counts[5] = {};
    for (const Outcome outcome : ranges_.outcome.reshaped()) ++counts[static_cast<int>(outcome)];
    equal_count(ranges_.objectives,
                ranges_.status == PolytopeStatus::kEmpty ? ranges_.objectives : 4 * ranges_.requested,
                "objectives");
    equal_count(ranges_.unbounded, counts[static_cast<int>(Outcome::kUnbounded)], "unbounded");
    equal_count(ranges_.certified, counts[static_cast<int>(Outcome::kOptimal)] + ranges_.unbounded,
                "certified");
    equal_count(ranges_.imprecise, counts[static_cast<int>(Outcome::kImprecise)], "imprecise");
    equal_count(ranges_.failed, counts[static_cast<int>(Outcome::kFailed)], "failed");
    check_sliding();
    check_choice();
  }

  void check_choice() {
    if (ranges_.status == PolytopeStatus::kEmpty) return;
    std::vector<double> delta_R;
    std::vector<double> delta_T;
    for (Eigen::Index i = 0; i < ranges_.outcome.rows(); ++i) {
      const auto left_out = (ranges_.outcome.row(i) == Outcome::kNotRequested).count();
      require(left_out == 0 || left_out == 4, "contact {}: only some of its objectives were left out", i);
      if (left_out > 0) continue;
      delta_R.push_back(ranges_.delta_R[i]);
      delta_T.push_back(ranges_.delta_T[i]);
    }
    equal_count(ranges_.requested, static_cast<std::int64_t>(delta_R.size()), "requested");
    if (ranges_.choice != ContactChoice::Kind::kSample) return;
    require(ranges_.sample_seed >= 0, "sample_seed: {} is stored", ranges_.sample_seed);
    check_estimate(ranges_.sample_R, delta_R, "delta_R");
    check_estimate(ranges_.sample_T, delta_T, "delta_T");
  }

  /// The mean of a sample. Moments by pairs: Σ (x_i − x_j)² = 2K(K − 1) s²,
  /// Σ (x_i − x_j)² (x_i + x_j − 2 mean) = 2K² γ s³. An end of the interval is put into the equation of
  /// contact_choice.h.
  void check_estimate(const SampleEstimate& stored, const std::vector<double>& values,
                      const std::string& name) {
    const auto count = static_cast<double>(values.size());
    const double left_out = 1 - count / packing_.contact_count();
    double sum = 0;
    double pairs = 0;
    double leaning = 0;
    for (const double a : values) sum += a;
    const double mean = values.empty() ? ForceRanges::kNaN : sum / count;
    for (const double a : values) {
      for (const double b : values) {
        pairs += (a - b) * (a - b);
        leaning += (a - b) * (a - b) * (a + b - 2 * mean);
      }
    }
    const double s = std::sqrt(pairs / (2 * count * (count - 1)));
    const bool has_interval = left_out > 0 && count >= kFewestForInterval && std::isfinite(mean);
    if (has_interval && s > 0) {
      const double skewness = leaning / (2 * count * count * s * s * s);
      const double quantile = boost::math::quantile(
          boost::math::complement(boost::math::students_t(count - 1), (1 - kConfidence) / 2));
      const auto transformed = [&](double end) {
        const double w = (mean - end) / (s * std::sqrt(left_out));
        return w + skewness * w * w / 3 + skewness * skewness * w * w * w / 27 + skewness / (6 * count);
      };
      equal(transformed(stored.low) * std::sqrt(count), quantile, "lower end of mean_" + name);
      equal(transformed(stored.high) * std::sqrt(count), -quantile, "upper end of mean_" + name);
    } else {
      const double end = has_interval || left_out == 0 ? mean : ForceRanges::kNaN;
      equal(stored.low, end, "lower end of mean_" + name);
      equal(stored.high, end, "upper end of mean_" + name);
    }
    const double band = std::sqrt(-std::log((1 - kConfidence) / 2) / 2 *
                                  (1 / count - (1 - 1 / count) / packing_.contact_count()));
    equal(stored.mean, mean, "mean_" + name);
    equal(stored.band, std::isnan(mean) ? mean : (left_out > 0 ? band : 0), "band_" + name);
  }

  void check_sliding() {
    if (!packing_.has_simulated_forces()) {
      equal_count(ranges_.sliding, -1, "sliding");
      return;
    }
    std::int64_t sliding = 0;
    std::int64_t idle = 0;
    for (const Contact& contact : packing_.contacts) {
      const double R = contact.R / ranges_.force_unit;
      const double T = std::abs(contact.T) / ranges_.force_unit;
      const bool transmits = std::abs(R) >= tolerance::kSliding || T >= tolerance::kSliding;
      idle += transmits ? 0 : 1;
      sliding += transmits && contact.mu > 0 && contact.mu * R - T < tolerance::kSliding ? 1 : 0;
    }
    equal_count(ranges_.sliding, sliding + 2 * idle, "sliding");
    equal_count(ranges_.non_transmitting, idle, "non_transmitting");
  }

  const Packing& packing_;
  const ForceRanges& ranges_;
  const ProgressCallback& progress_;
  Oracle oracle_;
  Verification report_;
  std::vector<double> residuals_;        ///< a state
  std::vector<std::vector<int>> tight_;  ///< a state: half-planes without slack
};

}  // namespace

Verification verify_ranges(const Packing& packing, const ForceRanges& ranges,
                           const ProgressCallback& progress) {
  return Verifier(packing, ranges, progress).run();
}

}  // namespace indet
