#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "libindet/base/constants.h"
#include "libindet/base/tolerances.h"
#include "libindet/dense/symmetric.h"
#include "libindet/verify/affine_hull.h"
#include "libindet/verify/samples_part.h"

namespace indet {
namespace {

/// Chains that have converged have no R̂ above this.
constexpr double kLargestRhat = 1.01;

class ComponentsCheck {
 public:
  explicit ComponentsCheck(const SamplesPart& part)
      : part_(part),
        compare_(part.compare),
        table_(*part.record.components),
        unit_(part.problem.force_unit()),
        deviation_(table_.deviation / unit_),
        samples_(part.number("samples")),
        hull_(AffineHull::at(part.problem, part.center)) {}

  void run() {
    check_which_are_determined();
    check_diagnostics();
    check_deviation();
    check_quantiles();
    check_covariance();
    check_states();
    check_place_of_start();
    name_the_rest();
  }

 private:
  std::string of(const char* name, Eigen::Index component) const {
    return fmt::format("{} of component {}", name, component);
  }

  void check_which_are_determined() {
    if (!hull_ || !hull_->freedom_is_clear()) return;
    for (Eigen::Index k = 0; k < deviation_.size(); ++k) {
      const bool moves = hull_->freedom(static_cast<int>(k)) > tolerance::kDeterminedForce;
      for (const auto& [name, values] : {std::pair("rhat", &table_.rhat), std::pair("bulk_ess", &table_.bulk),
                                         std::pair("tail_ess", &table_.tail)}) {
        const double value = (*values)[k];
        compare_.require(std::isnan(value) != moves, "{}: {} is stored, but the force is {}", of(name, k),
                         value, moves ? "not determined" : "determined");
      }
      compare_.require(moves ? deviation_[k] > 0 : deviation_[k] <= tolerance::kRoundingRoom * part_.scale,
                       "{}: {} is stored, but the force is {}", of("deviation", k), table_.deviation[k],
                       moves ? "not determined" : "determined");
    }
  }

  /// Antithetic samples are worth at most S log S, as in the definition.
  void check_diagnostics() {
    const double most = samples_ * std::log10(samples_) * (1 + tolerance::kRoundingRoom);
    double rhat = part_.number("norm_rhat");
    double bulk = part_.number("norm_bulk_ess");
    double tail = part_.number("norm_tail_ess");
    const bool knows_norm = part_.has("norm_rhat");
    const auto components = deviation_.size();
    Eigen::Index slowest = knows_norm ? components : -1;
    for (Eigen::Index k = components; k-- > 0;) {
      if (std::isnan(table_.bulk[k])) continue;
      compare_.require(table_.rhat[k] > 0, "{}: {}", of("rhat", k), table_.rhat[k]);
      compare_.require(table_.bulk[k] > 0 && table_.bulk[k] <= most, "{}: {} of {} samples",
                       of("bulk_ess", k), table_.bulk[k], samples_);
      compare_.require(table_.tail[k] > 0 && table_.tail[k] <= most, "{}: {} of {} samples",
                       of("tail_ess", k), table_.tail[k], samples_);
      // The first of those with the fewest.
      const double own = std::min(table_.bulk[k], table_.tail[k]);
      if (!(own > std::fmin(bulk, tail))) slowest = k;
      rhat = std::fmax(rhat, table_.rhat[k]);
      bulk = std::fmin(bulk, table_.bulk[k]);
      tail = std::fmin(tail, table_.tail[k]);
    }
    if (knows_norm) {
      compare_.equal(part_.number("rhat"), rhat, "rhat");
      compare_.equal(part_.number("bulk_ess"), bulk, "bulk_ess");
      compare_.equal(part_.number("tail_ess"), tail, "tail_ess");
      compare_.equal(part_.number("slowest"), static_cast<double>(slowest), "slowest");
      part_.require_in("norm_rhat", 0, kInfinity);
      part_.require_in("norm_bulk_ess", 0, most);
      part_.require_in("norm_tail_ess", 0, most);
    } else {
      part_.require_in("rhat", rhat, kInfinity);
      part_.require_in("bulk_ess", 0, bulk);
      part_.require_in("tail_ess", 0, tail);
      part_.require_in("slowest", 0, static_cast<double>(components));
    }
    const double least = std::min(part_.number("bulk_ess"), part_.number("tail_ess"));
    compare_.equal(part_.number("ess"), least, "ess");
    const bool converged = part_.number("rhat") <= kLargestRhat && least >= part_.number("requested");
    compare_.equal(part_.number("converged"), converged ? 1 : 0, "converged");
    if (!converged)
      compare_.call_unsolved(fmt::format(
          "sample not converged: R-hat up to {:.4f}, {:.0f} effective samples of {:.0f} asked for",
          part_.number("rhat"), least, part_.number("requested")));
  }

  void check_deviation() {
    compare_.equal(part_.number("r"), deviation_.norm(), "r", tolerance::kSumAgreement);
  }

  /// Order, sign, and how far from the mean a fraction of the samples can be (Cantelli): of n samples, n − k
  /// can be at or above mean + σ √(k/(n − k)) at most.
  void check_quantiles() {
    const Eigen::Index levels = table_.quantile_levels.size();
    for (Eigen::Index q = 0; q < levels; ++q) {
      const double level = table_.quantile_levels[q];
      constexpr std::array kLevels = {0.05, 0.25, 0.5, 0.75, 0.95};
      compare_.equal(level, q < 5 ? kLevels[static_cast<std::size_t>(q)] : Verification::kNaN,
                     "quantile_levels");
      const double place = level * (samples_ - 1);
      const double below = std::floor(place);
      const double above = std::ceil(place);
      const double up = std::sqrt(above / (samples_ - above));
      const double down = std::sqrt((samples_ - 1 - below) / (below + 1));
      for (Eigen::Index k = 0; k < deviation_.size(); ++k) {
        const double value = table_.quantiles(k, q) / unit_;
        const double mean = part_.center[k];
        const double rounding = tolerance::kRoundingRoom * part_.scale;
        compare_.require(
            value >= mean - down * deviation_[k] - rounding && value <= mean + up * deviation_[k] + rounding,
            "{}: {} mg at level {} is too far from the mean {}", of("quantiles", k), value, level, mean);
        compare_.require(q == 0 || table_.quantiles(k, q - 1) <= table_.quantiles(k, q),
                         "{}: they do not ascend", of("quantiles", k));
        compare_.require(k % 2 == 1 || value >= -rounding, "{}: {} mg, but R is never negative",
                         of("quantiles", k), value);
      }
    }
  }

  /// Symmetric, with the variances as diagonal, within the directions of F, and nowhere negative.
  void check_covariance() {
    if (table_.covariance.size() == 0) return;
    const Eigen::MatrixXd covariance = table_.covariance / (unit_ * unit_);
    const double scale = std::max(tolerance::kAgreement, covariance.cwiseAbs().maxCoeff());
    compare_.require(
        (covariance - covariance.transpose()).cwiseAbs().maxCoeff() <= tolerance::kSumAgreement * scale,
        "covariance: it is not symmetric");
    for (Eigen::Index k = 0; k < covariance.rows(); ++k)
      compare_.equal(covariance(k, k), deviation_[k] * deviation_[k], of("covariance", k),
                     tolerance::kSumAgreement, part_.scale * part_.scale * tolerance::kAgreement);
    double outside = 0;
    for (Eigen::Index k = 0; k < covariance.cols(); ++k)
      outside = std::max(outside, part_.problem.imbalance_without_load(covariance.col(k)));
    compare_.require(outside <= tolerance::kSumAgreement * scale,
                     "covariance: it is not within the null space ({})", outside);
    if (!hull_) return;
    const Eigen::MatrixXd& D = hull_->directions();
    const Eigen::MatrixXd within = D.transpose() * covariance * D;
    compare_.require(
        (covariance - D * within * D.transpose()).cwiseAbs().maxCoeff() <= tolerance::kSumAgreement * scale,
        "covariance: it has directions in which F does not extend");
    const double least = eigenvalues_of(within).minCoeff();
    compare_.require(least >= -tolerance::kSumAgreement * scale, "covariance: a variance is {}", least);
  }

  /// Each is a state; their mean is as near to the centre as that of a part of the samples must be: of n
  /// values with standard deviation σ the mean of any K is within σ √((n − K)/K) of the mean of all.
  void check_states() {
    const Eigen::Index count = table_.states.cols();
    double worst = part_.problem.imbalance(part_.center);
    for (Eigen::Index i = 0; i < count; ++i) {
      const Eigen::VectorXd state = table_.states.col(i) / unit_;
      const double residual = compare_.add_state(part_.problem, state);
      compare_.require(residual <= tolerance::kPrimalResidual * part_.scale,
                       "state {}: it violates equilibrium or contact conditions by {} mg", i, residual);
      worst = std::max(worst, part_.problem.imbalance(state));
    }
    if (part_.has("worst_residual") && count > 0)
      compare_.equal(part_.number("worst_residual"), worst, "worst_residual", tolerance::kAgreement,
                     part_.scale);
    if (part_.has("worst_residual") && count == 0)
      part_.require_in("worst_residual", worst - tolerance::kAgreement * part_.scale,
                       tolerance::kPrimalResidual * part_.scale);
    compare_.require(static_cast<double>(count) <= samples_, "states: {} of {} samples", count, samples_);
    if (count == 0) return;
    const auto K = static_cast<double>(count);
    const double bound = std::sqrt(std::max(0.0, samples_ - K) / K);
    const Eigen::VectorXd mean = table_.states.rowwise().mean() / unit_;
    for (Eigen::Index k = 0; k < mean.size(); ++k) {
      compare_.require(std::abs(mean[k] - part_.center[k]) <=
                           bound * deviation_[k] + tolerance::kSumAgreement * part_.scale,
                       "{}: {} mg, but the {} states have the mean {}", of("center", k), part_.center[k],
                       count, mean[k]);
    }
  }

  /// Where the simulated R of each contact lies among its samples, as far as the quantiles tell.
  void check_place_of_start() {
    if (!part_.has("start_distance")) return;
    const Eigen::VectorXd start = part_.start();
    int inside = 0;
    int counted = 0;
    for (Eigen::Index i = 0; i < start.size() / 2; ++i) {
      const double R = start[2 * i];
      const auto quantiles = table_.quantiles.row(2 * i) / unit_;
      const bool moves = deviation_[2 * i] > part_.epsilon();
      counted += moves ? 1 : 0;
      inside += moves && quantiles(0) <= R && R <= quantiles(table_.quantile_levels.size() - 1) ? 1 : 0;
      if (table_.percentile_R.size() > 0) check_percentile(i, moves, R);
    }
    compare_.equal(part_.number("start_central_fraction_R"),
                   counted > 0 ? static_cast<double>(inside) / counted : Verification::kNaN,
                   "start_central_fraction_R");
  }

  void check_percentile(Eigen::Index contact, bool moves, double R) {
    const double percentage = table_.percentile_R[contact];
    const std::string name = fmt::format("percentile_R of contact {}", contact);
    if (!compare_.require(std::isnan(percentage) != moves, "{}: {} is stored, but the force is {}", name,
                          percentage, moves ? "not determined" : "determined") ||
        !moves) {
      return;
    }
    const double smaller = percentage / 100 * samples_;
    compare_.require(percentage >= 0 && percentage <= 100 &&
                         std::abs(smaller - std::round(smaller)) < tolerance::kWholeCount,
                     "{}: {} is not a percentage of {} samples", name, percentage, samples_);
    for (Eigen::Index q = 0; q < table_.quantile_levels.size(); ++q) {
      const double place = table_.quantile_levels[q] * (samples_ - 1);
      const double quantile = table_.quantiles(2 * contact, q) / unit_;
      const bool agrees = R > quantile ? smaller >= std::floor(place) : smaller <= std::ceil(place) + 1;
      compare_.require(agrees, "{}: {} contradicts the quantile {}", name, percentage,
                       table_.quantile_levels[q]);
    }
  }

  void name_the_rest() {
    if (has_whole_sample(part_)) return;
    const Eigen::Index count = table_.states.cols();
    compare_.leave_unchecked(fmt::format(
        "center as the mean, deviation, quantiles, covariance, r, r_error, spread, mean_norm, "
        "norm_deviation, "
        "rhat, bulk_ess, tail_ess, norm_rhat, norm_bulk_ess, norm_tail_ess, percentiles, most_sliding ({}; "
        "they were compared with each other and "
        "with "
        "bounds that hold for all samples)",
        count == 0
            ? fmt::format("of the {} samples none is stored", samples_)
            : fmt::format("of the {} samples {} {} stored", samples_, count, count == 1 ? "is" : "are")));
  }

  const SamplesPart& part_;
  Comparisons& compare_;
  const ComponentRecord& table_;
  double unit_;
  Eigen::VectorXd deviation_;  ///< mg
  double samples_;
  std::optional<AffineHull> hull_;
};

}  // namespace

void check_components(const SamplesPart& part) { ComponentsCheck(part).run(); }

bool has_whole_sample(const SamplesPart& part) {
  return part.record.components && part.record.components->states.cols() > 0 &&
         static_cast<double>(part.record.components->states.cols()) == part.number("samples");
}

}  // namespace indet
