#include "libindet/verify/bias_check.h"

#include <algorithm>
#include <array>
#include <boost/math/special_functions/beta.hpp>
#include <cmath>

#include "libindet/base/tolerances.h"
#include "libindet/verify/comparisons.h"

namespace indet {
namespace {

/// Fewer effective states than this of a contact are not tested.
constexpr double kFewestForTest = 20;
/// Of false discoveries.
constexpr double kRate = 0.05;

class BiasCheck {
 public:
  BiasCheck(const Packing& packing, const BiasRecord& bias, const SamplingRecord& chain,
            const SamplingRecord& uniform, const ForceRanges* ranges)
      : bias_(bias),
        chain_(chain),
        uniform_(uniform),
        ranges_(ranges),
        contacts_(packing.contact_count()),
        unit_(packing.force_unit()),
        epsilon_(tolerance::kSliding * packing.force_units().internal_in_weights()) {}

  Verification run() {
    const bool fits =
        compare_.require(chain_.method == "perturb" && uniform_.method == "uniform",
                         "the samplings that are compared are not there") &&
        compare_.require(has_all_columns(), "a table is missing") &&
        compare_.require(chain_.center.size() == 2 * contacts_ && uniform_.center.size() == 2 * contacts_ &&
                             uniform_.components && uniform_.components->deviation.size() == 2 * contacts_,
                         "the samplings are not of these contacts");
    if (!fits) return compare_.result();
    check_radii();
    check_centres();
    check_contacts();
    check_discoveries();
    check_histograms(bias_.uniform, number(uniform_, "samples"), uniform_.center, "uniform");
    check_histograms(bias_.perturb, number(chain_, "accepted"), chain_.center, "perturb");
    compare_.leave_unchecked(
        "r_error, center_noise, center_shift_error, deviation_R, effective_R, uniform_effective_R, "
        "p_distribution, "
        "control_p_mean, control_p_distribution and the bins of the histograms (the states are not stored; "
        "totals and bounds were checked)");
    return compare_.result();
  }

 private:
  bool has_all_columns() const {
    constexpr std::array kColumns = {"mean_R",         "deviation_R",    "effective_R",           "p_mean",
                                     "p_distribution", "control_p_mean", "control_p_distribution"};
    return std::all_of(kColumns.begin(), kColumns.end(),
                       [&](const char* name) { return bias_.contacts.contains(name); });
  }
  const Eigen::VectorXd& column(const char* name) const { return bias_.contacts.at(name); }
  double number(const char* name) const {
    const auto found = bias_.numbers.find(name);
    return found == bias_.numbers.end() ? Verification::kNaN : found->second;
  }
  static double number(const SamplingRecord& record, const char* name) {
    const auto found = record.numbers.find(name);
    return found == record.numbers.end() ? Verification::kNaN : found->second;
  }
  double deviation(Eigen::Index contact) const { return uniform_.components->deviation[2 * contact] / unit_; }
  bool moves(Eigen::Index contact) const { return deviation(contact) > epsilon_; }

  void check_radii() {
    const double r = number("r");
    const double uniform = number(uniform_, "r");
    const double ratio = r / uniform;
    compare_.equal(r, number(chain_, "r"), "r", tolerance::kSumAgreement);
    compare_.equal(number("ratio"), ratio, "ratio");
    compare_.equal(number("ratio_error"),
                   std::hypot(number("r_error"), ratio * number(uniform_, "r_error")) / uniform,
                   "ratio_error");
    compare_.require(number("r_error") >= 0, "r_error: {}", number("r_error"));
    compare_.equal(number("states"), number(chain_, "accepted"), "states");
  }

  void check_centres() {
    const double distance = (chain_.center - uniform_.center).norm() / unit_;
    const double noise = number("center_noise");
    compare_.equal(number("center_shift"), std::sqrt(std::max(0.0, distance * distance - noise * noise)),
                   "center_shift", tolerance::kSumAgreement, std::max(1.0, distance));
    compare_.require(number("center_shift_error") >= 0, "center_shift_error: {}",
                     number("center_shift_error"));
  }

  void check_contacts() {
    const bool knows_effective = bias_.contacts.contains("uniform_effective_R");
    double squares = 0;
    double noise = 0;
    for (Eigen::Index i = 0; i < contacts_; ++i) {
      const auto of = [i](const char* name) { return fmt::format("{} of contact {}", name, i); };
      const double mean = column("mean_R")[i];
      const double own = column("deviation_R")[i];
      const double effective = column("effective_R")[i];
      compare_.equal(mean, chain_.center[2 * i] / unit_, of("mean_R"), tolerance::kSumAgreement);
      compare_.require(own >= 0, "{}: {}", of("deviation_R"), own);
      // NaN where the force is determined, or where the chain never moved it.
      const bool has_effective = moves(i) && !std::isnan(effective);
      compare_.require(has_effective
                           ? effective > 0
                           : std::isnan(effective) && (!moves(i) || own <= tolerance::kRoundingRoom),
                       "{}: {} is stored, but the force is {}", of("effective_R"), effective,
                       moves(i) ? "not determined" : "determined");
      squares += own * own;
      const bool is_tested = moves(i) && effective >= kFewestForTest;
      for (const char* name : {"p_mean", "p_distribution"}) check_probability(name, i, is_tested);
      for (const char* name : {"control_p_mean", "control_p_distribution"})
        check_probability(name, i, moves(i));
      if (has_effective) noise += own * own / effective;
      if (!knows_effective || !moves(i)) continue;
      const double uniform_effective = column("uniform_effective_R")[i];
      compare_.require(uniform_effective > 0, "{}: {}", of("uniform_effective_R"), uniform_effective);
      noise += deviation(i) * deviation(i) / uniform_effective;
      if (is_tested) check_welch(i, uniform_effective);
    }
    const double r = number("r");
    compare_.require(squares <= r * r * (1 + tolerance::kRoundingRoom),
                     "deviation_R: their squares are more than r² = {}", r * r);
    compare_.require(
        noise <= number("center_noise") * number("center_noise") * (1 + tolerance::kRoundingRoom),
        "center_noise: {} is less than the noise of R alone", number("center_noise"));
    if (!knows_effective)
      compare_.leave_unchecked("p_mean (the file does not hold the effective sizes of the uniform sample)");
  }

  void check_probability(const char* name, Eigen::Index contact, bool is_tested) {
    const double p = column(name)[contact];
    const bool agrees = is_tested ? p >= 0 && p <= 1 : std::isnan(p);
    compare_.require(agrees, "{} of contact {}: {} is stored, but the contact is {}", name, contact, p,
                     is_tested ? "tested" : "not tested");
  }

  /// Student's distribution by the incomplete beta function: P(|t| ≥ x) = I_{ν/(ν + x²)}(ν/2, 1/2).
  void check_welch(Eigen::Index contact, double uniform_effective) {
    const double n_a = number("states");
    const double n_b = number(uniform_, "samples");
    const double effective = column("effective_R")[contact];
    const double own = column("deviation_R")[contact];
    const double a = own * own * n_a / (n_a - 1) / effective;
    const double b = deviation(contact) * deviation(contact) * n_b / (n_b - 1) / uniform_effective;
    const double difference = column("mean_R")[contact] - uniform_.center[2 * contact] / unit_;
    const double freedom = (a + b) * (a + b) / (a * a / (effective - 1) + b * b / (uniform_effective - 1));
    const double square = difference * difference / (a + b);
    compare_.equal_probability(column("p_mean")[contact],
                               boost::math::ibeta(freedom / 2, 0.5, freedom / (freedom + square)),
                               fmt::format("p_mean of contact {}", contact));
  }

  /// The largest k with k p-values of at most rate · k/m among all m.
  static std::int64_t discoveries(const Eigen::VectorXd& p) {
    const auto m = p.size() - p.array().isNaN().count();
    for (Eigen::Index k = m; k > 0; --k) {
      const double limit = kRate * static_cast<double>(k) / static_cast<double>(m);
      if ((p.array() <= limit).count() >= k) return k;
    }
    return 0;
  }

  void check_discoveries() {
    const auto count = [&](const char* name, const char* p) {
      compare_.equal(number(name), static_cast<double>(discoveries(column(p))), name);
    };
    const Eigen::VectorXd& p = column("p_mean");
    compare_.equal(number("tested"), static_cast<double>(p.size() - p.array().isNaN().count()), "tested");
    count("means", "p_mean");
    count("distributions", "p_distribution");
    count("control_means", "control_p_mean");
    count("control_distributions", "control_p_distribution");
  }

  /// What the values in a histogram add up to, divided by the number of states, and of how many contacts they
  /// are.
  struct Content {
    double sum = 0;
    Eigen::Index contacts = 0;
    void add(double value) {
      sum += value;
      ++contacts;
    }
  };

  void check_histograms(const BiasRecord::SampledForces& forces, double states, const Eigen::VectorXd& center,
                        const std::string& name) {
    compare_.equal(static_cast<double>(forces.states), states, name + "/states");
    Content force;
    Content standard;
    Content place;
    for (Eigen::Index i = 0; i < contacts_; ++i) {
      const double R = center[2 * i] / unit_;
      force.add(R);
      if (moves(i)) standard.add((R - uniform_.center[2 * i] / unit_) / deviation(i));
      const double range = ranges_ == nullptr ? 0 : ranges_->delta_R[i];
      if (range > epsilon_ && std::isfinite(range))
        place.add((R - ranges_->value(i, kMinR) / ranges_->force_unit) / range);
    }
    check_histogram(forces.force, 1, force, states, name + "/R");
    check_histogram(forces.standard, 0.25, standard, states, name + "/standard_R");
    if (ranges_ != nullptr) check_histogram(forces.place, 0.05, place, states, name + "/R_star");
  }

  /// The total, and the sum of the values to the width of a bin.
  void check_histogram(const BiasRecord::Histogram& histogram, double width, const Content& content,
                       double states, const std::string& name) {
    double total = 0;
    double low = 0;
    for (std::size_t k = 0; k < histogram.counts.size(); ++k) {
      const double count = histogram.counts[k];
      compare_.require(count >= 0, "{}: {} in bin {}", name, count, k);
      total += count;
      low += count * width * (static_cast<double>(histogram.first) + static_cast<double>(k));
    }
    const double sum = content.sum * states;
    const double rounding = tolerance::kRoundingRoom * std::max({1.0, std::abs(sum), std::abs(low)});
    compare_.equal(histogram.width, width, name + "@width");
    compare_.equal(total, static_cast<double>(content.contacts) * states, name);
    compare_.require(low <= sum + rounding && sum <= low + width * total + rounding,
                     "{}: the values add up to {}, which the bins from {} do not", name, sum,
                     histogram.first);
  }

  const BiasRecord& bias_;
  const SamplingRecord& chain_;
  const SamplingRecord& uniform_;
  const ForceRanges* ranges_;
  Eigen::Index contacts_;
  double unit_;
  double epsilon_;  ///< below it a force counts as nothing (mg)
  Comparisons compare_{"/bias"};
};

}  // namespace

Verification verify_bias(const Packing& packing, const BiasRecord& bias, const SamplingRecord& chain,
                         const SamplingRecord& uniform, const ForceRanges* ranges) {
  return BiasCheck(packing, bias, chain, uniform, ranges).run();
}

}  // namespace indet
