#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "libindet/base/tolerances.h"
#include "libindet/verify/chain_diagnostics.h"
#include "libindet/verify/samples_part.h"

namespace indet {
namespace {

class WholeSampleCheck {
 public:
  explicit WholeSampleCheck(const SamplesPart& part)
      : part_(part),
        compare_(part.compare),
        table_(*part.record.components),
        unit_(part.problem.force_unit()),
        states_(table_.states / unit_),
        count_(static_cast<double>(states_.cols())),
        chains_(static_cast<Eigen::Index>(std::fmin(std::fmax(part.number("chains"), 0), count_))) {}

  void run() {
    const bool divides = chains_ >= 2 && states_.cols() % chains_ == 0 && states_.cols() / chains_ >= 8;
    if (!compare_.require(divides, "chains: {} samples are not those of {} chains", states_.cols(), chains_))
      return;
    mean_ = states_.rowwise().mean();
    centred_ = states_.colwise() - mean_;
    check_components();
    check_covariance();
    check_size();
    check_place();
  }

 private:
  void close(double stored, double expected, const std::string& name) {
    compare_.equal(stored, expected, name, tolerance::kSumAgreement, part_.scale);
  }

  Eigen::MatrixXd as_chains(const Eigen::VectorXd& values) const {
    return Eigen::Map<const Eigen::MatrixXd>(values.data(), values.size() / chains_, chains_);
  }

  void check_components() {
    for (Eigen::Index k = 0; k < states_.rows(); ++k) {
      const Eigen::VectorXd values = states_.row(k).transpose();
      const auto of = [k](const char* name) { return fmt::format("{} of component {}", name, k); };
      const double deviation = centred_.row(k).norm() / std::sqrt(count_);
      close(part_.center[k], mean_[k], of("center"));
      close(table_.deviation[k] / unit_, deviation, of("deviation"));
      check_quantiles(k, values);
      if (std::isnan(table_.bulk[k]) || deviation <= tolerance::kRankableDeviation * part_.scale) continue;
      check_diagnostics(table_.rhat[k], table_.bulk[k], table_.tail[k], values,
                        fmt::format("component {}", k));
    }
  }

  void check_quantiles(Eigen::Index k, Eigen::VectorXd values) {
    std::sort(values.begin(), values.end());
    for (Eigen::Index q = 0; q < table_.quantile_levels.size(); ++q) {
      const double place = table_.quantile_levels[q] * (count_ - 1);
      const auto below = static_cast<Eigen::Index>(std::clamp(place, 0.0, count_ - 1));
      const Eigen::Index above = std::min(below + 1, values.size() - 1);
      const double part = place - static_cast<double>(below);
      close(table_.quantiles(k, q) / unit_, (1 - part) * values[below] + part * values[above],
            fmt::format("quantile {} of component {}", table_.quantile_levels[q], k));
    }
  }

  void check_diagnostics(double rhat, double bulk, double tail, const Eigen::VectorXd& values,
                         const std::string& of) {
    const ChainDiagnostics right = diagnose_chains(as_chains(values));
    const auto nearest = *std::min_element(right.rhat.begin(), right.rhat.end(), [&](double a, double b) {
      return std::abs(a - rhat) < std::abs(b - rhat);
    });
    compare_.equal(rhat, nearest, "rhat of " + of, tolerance::kDiagnosticAgreement);
    compare_.equal(bulk, right.bulk, "bulk_ess of " + of, tolerance::kDiagnosticAgreement);
    compare_.equal(tail, right.tail, "tail_ess of " + of, tolerance::kDiagnosticAgreement);
  }

  void check_covariance() {
    if (table_.covariance.size() == 0) return;
    const Eigen::MatrixXd right = centred_ * centred_.transpose() / count_;
    const double worst = (table_.covariance / (unit_ * unit_) - right).cwiseAbs().maxCoeff();
    compare_.require(worst <= tolerance::kSumAgreement * right.cwiseAbs().maxCoeff(),
                     "covariance: it differs from that of the states by {}", worst);
  }

  void check_size() {
    const Eigen::VectorXd squares = centred_.colwise().squaredNorm().transpose();
    const Eigen::VectorXd distances = squares.cwiseSqrt();
    const Eigen::VectorXd norms = states_.colwise().norm().transpose();
    const auto deviation = [](const Eigen::VectorXd& v) {
      return (v.array() - v.mean()).matrix().norm() / std::sqrt(static_cast<double>(v.size()));
    };
    const double r = std::sqrt(squares.mean());
    close(part_.number("r"), r, "r");
    close(part_.number("spread"), deviation(distances), "spread");
    close(part_.number("mean_norm"), norms.mean(), "mean_norm");
    close(part_.number("norm_deviation"), deviation(norms), "norm_deviation");
    if (r > tolerance::kRankableDeviation * part_.scale) {
      compare_.equal(part_.number("r_error"),
                     deviation(squares) / std::sqrt(effective_size_of_mean(as_chains(squares))) / (2 * r),
                     "r_error", tolerance::kDiagnosticAgreement);
    }
    if (part_.has("norm_rhat") && deviation(norms) > tolerance::kRankableDeviation * part_.scale)
      check_diagnostics(part_.number("norm_rhat"), part_.number("norm_bulk_ess"),
                        part_.number("norm_tail_ess"), norms, "the norm");
  }

  /// Percentages of the states with a smaller value of `measure` than the simulated one.
  void check_percentile(const char* name, const Eigen::VectorXd& start,
                        const std::function<double(const Eigen::VectorXd&)>& measure) {
    if (!part_.has(name)) return;
    const double own = measure(start);
    double smaller = 0;
    for (Eigen::Index i = 0; i < states_.cols(); ++i) smaller += measure(states_.col(i)) < own ? 1 : 0;
    compare_.equal(part_.number(name), std::isnan(own) ? own : 100 * smaller / count_, name);
  }

  void check_place() {
    if (!part_.has("start_distance")) return;
    const Eigen::VectorXd start = part_.start();
    check_percentile("start_distance_percentile", start,
                     [&](const Eigen::VectorXd& F) { return (F - part_.center).norm(); });
    check_percentile("start_norm_percentile", start, [](const Eigen::VectorXd& F) { return F.norm(); });
    check_percentile("start_normal_force_percentile", start, [](const Eigen::VectorXd& F) {
      return Eigen::Map<const Eigen::Matrix2Xd>(F.data(), 2, F.size() / 2).row(0).sum();
    });
    check_percentile("start_mobilisation_percentile", start,
                     [&](const Eigen::VectorXd& F) { return mean_mobilisation(F); });
    const int own = part_.problem.count_sliding(start).sliding;
    int most = 0;
    double below = 0;
    for (Eigen::Index i = 0; i < states_.cols(); ++i) {
      const int sliding = part_.problem.count_sliding(states_.col(i)).sliding;
      most = std::max(most, sliding);
      below += sliding < own ? 1 : (sliding == own ? 0.5 : 0);
    }
    compare_.equal(part_.number("most_sliding"), most, "most_sliding");
    compare_.equal(part_.number("start_sliding_percentile"), 100 * below / count_,
                   "start_sliding_percentile");
    if (part_.has("start_R_star_percentile"))
      compare_.leave_unchecked("start_mean_R_star, start_R_star_percentile (the ranges are not in the file)");
  }

  double mean_mobilisation(const Eigen::VectorXd& F) const {
    double sum = 0;
    int count = 0;
    for (int i = 0; i < part_.packing.contact_count(); ++i) {
      const double limit = part_.packing[ContactId(i)].mu * F[2 * i];
      if (!(limit > part_.epsilon())) continue;
      sum += std::abs(F[2 * i + 1]) / limit;
      ++count;
    }
    return count > 0 ? sum / count : Verification::kNaN;
  }

  const SamplesPart& part_;
  Comparisons& compare_;
  const ComponentRecord& table_;
  double unit_;
  Eigen::MatrixXd states_;  ///< 2M × samples, chain after chain, mg
  double count_;
  Eigen::Index chains_;
  Eigen::VectorXd mean_;
  Eigen::MatrixXd centred_;
};

}  // namespace

void check_whole_sample(const SamplesPart& part) { WholeSampleCheck(part).run(); }

}  // namespace indet
