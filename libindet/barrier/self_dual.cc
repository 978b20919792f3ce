#include "libindet/barrier/self_dual.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "libindet/barrier/vectors.h"
#include "libindet/base/tolerances.h"

namespace indet::barrier {
namespace {

double larger_over_smaller(double a, double b) { return std::max(a / b, b / a); }

class SelfDualSearch {
 public:
  SelfDualSearch(const BlockStructure& structure, BlockCholesky& cholesky, std::span<const double> b,
                 std::span<const double> c)
      : structure_(structure),
        cholesky_(cholesky),
        b_(b),
        c_(c),
        n_(c.size()),
        D_(n_),
        corrector_(n_),
        dx_(n_),
        ds_(n_) {
    at_.x.assign(n_, 1);
    at_.s.assign(n_, 1);
    at_.y.assign(b.size(), 0);
  }

  SelfDualPoint run() {
    SelfDualPoint best = at_;
    int idle = 0;
    for (int iteration = 1; iteration <= kMostIterations; ++iteration) {
      if (!step()) break;
      at_.iterations = iteration;
      find_margin();
      if (!std::isfinite(at_.margin) || !std::isfinite(mu())) break;
      idle = at_.margin > 2 * best.margin ? 0 : idle + 1;
      if (at_.margin > best.margin || best.margin < 10) best = at_;
      const bool is_clear = at_.margin >= tolerance::kClearSplit && mu() <= tolerance::kSelfDualPath;
      if (is_clear || idle >= kMostIdle) break;
    }
    best.iterations = at_.iterations;
    return best;
  }

 private:
  static constexpr int kMostIterations = 200;
  static constexpr int kMostIdle = 30;
  static constexpr double kShare = 0.99;  ///< of the way to the nearest bound

  double mu() const { return (dot(at_.x, at_.s) + at_.tau * at_.kappa) / (static_cast<double>(n_) + 1); }

  void find_margin() {
    at_.margin = larger_over_smaller(at_.tau, at_.kappa);
    for (std::size_t k = 0; k < n_; ++k)
      at_.margin = std::min(at_.margin, larger_over_smaller(at_.x[k], at_.s[k]));
  }

  void find_residuals() {
    primal_ = product(structure_, at_.x);
    for (std::size_t i = 0; i < primal_.size(); ++i) primal_[i] = b_[i] * at_.tau - primal_[i];
    dual_ = transposed_product(structure_, at_.y);
    for (std::size_t k = 0; k < n_; ++k) dual_[k] = c_[k] * at_.tau - dual_[k] - at_.s[k];
    gap_ = at_.kappa + dot(c_, at_.x) - dot(b_, at_.y);
  }

  /// With D = X S⁻¹ and M = A D Aᵀ: dy = u + v dτ, dx = p + q dτ, where
  ///
  ///   M v = b + A D c,                      q = D (Aᵀ v − c)
  ///   M u = η r_p − A (S⁻¹ r_xs − η D r_d),  p = S⁻¹ r_xs − η D r_d + D Aᵀ u
  ///
  /// and r_xs = target − x s, so that the last equation gives dτ; its factor −κ/τ + c·q − b·v is
  /// −κ/τ − q·D⁻¹ q.
  void find_direction(double eta, double target) {
    std::vector<double> p(n_);
    for (std::size_t k = 0; k < n_; ++k)
      p[k] = (target - at_.x[k] * at_.s[k] - corrector_[k]) / at_.s[k] - eta * D_[k] * dual_[k];
    dy_ = product(structure_, p);
    for (std::size_t i = 0; i < dy_.size(); ++i) dy_[i] = eta * primal_[i] - dy_[i];
    cholesky_.solve(dy_);
    const std::vector<double> along = transposed_product(structure_, dy_);
    for (std::size_t k = 0; k < n_; ++k) p[k] += D_[k] * along[k];
    const double r_tk = target - at_.tau * at_.kappa - tau_corrector_;
    const double right = eta * gap_ + r_tk / at_.tau + dot(c_, p) - dot(b_, dy_);
    dtau_ = right / (at_.kappa / at_.tau + curvature_);
    dkappa_ = (r_tk - at_.kappa * dtau_) / at_.tau;
    for (std::size_t k = 0; k < n_; ++k) {
      dx_[k] = p[k] + q_[k] * dtau_;
      ds_[k] = eta * dual_[k] - along[k] - (along_v_[k] - c_[k]) * dtau_;
    }
    for (std::size_t i = 0; i < dy_.size(); ++i) dy_[i] += v_[i] * dtau_;
  }

  /// The way to the nearest bound, at most 1 / share.
  double longest_step() const {
    double step = 1 / kShare;
    const auto limit = [&](double value, double change) {
      if (change < 0) step = std::min(step, -value / change);
    };
    for (std::size_t k = 0; k < n_; ++k) {
      limit(at_.x[k], dx_[k]);
      limit(at_.s[k], ds_[k]);
    }
    limit(at_.tau, dtau_);
    limit(at_.kappa, dkappa_);
    return step;
  }

  bool step() {
    find_residuals();
    for (std::size_t k = 0; k < n_; ++k) D_[k] = at_.x[k] / at_.s[k];
    cholesky_.factor(D_);
    std::vector<double> weighted(n_);
    for (std::size_t k = 0; k < n_; ++k) weighted[k] = D_[k] * c_[k];
    v_ = product(structure_, weighted);
    for (std::size_t i = 0; i < v_.size(); ++i) v_[i] += b_[i];
    cholesky_.solve(v_);
    along_v_ = transposed_product(structure_, v_);
    q_.resize(n_);
    curvature_ = 0;
    for (std::size_t k = 0; k < n_; ++k) {
      q_[k] = D_[k] * (along_v_[k] - c_[k]);
      curvature_ += q_[k] * (along_v_[k] - c_[k]);
    }
    std::fill(corrector_.begin(), corrector_.end(), 0.0);
    tau_corrector_ = 0;
    find_direction(1, 0);
    const double reach = std::min(1.0, longest_step());
    const double centring = (1 - reach) * (1 - reach) * std::min(0.5, 1 - reach) + 1e-6;
    const double now = mu();
    for (std::size_t k = 0; k < n_; ++k)
      corrector_[k] = std::clamp(reach * reach * dx_[k] * ds_[k], -now, now);
    tau_corrector_ = std::clamp(reach * reach * dtau_ * dkappa_, -now, now);
    find_direction(1 - centring, centring * now);
    length_ = std::min(1.0, kShare * longest_step());
    if (!(length_ > kShortest)) return false;
    for (std::size_t k = 0; k < n_; ++k) {
      at_.x[k] += length_ * dx_[k];
      at_.s[k] += length_ * ds_[k];
    }
    for (std::size_t i = 0; i < dy_.size(); ++i) at_.y[i] += length_ * dy_[i];
    at_.tau += length_ * dtau_;
    at_.kappa += length_ * dkappa_;
    return true;
  }
  static constexpr double kShortest = 1e-8;

  const BlockStructure& structure_;
  BlockCholesky& cholesky_;
  std::span<const double> b_, c_;
  std::size_t n_;
  SelfDualPoint at_;
  std::vector<double> D_, corrector_, dx_, ds_, dy_, v_, along_v_, q_;
  std::vector<double> primal_, dual_;  ///< b τ − A x, c τ − Aᵀ y − s
  double gap_ = 0;                     ///< κ + c·x − b·y
  double curvature_ = 0, tau_corrector_ = 0, dtau_ = 0, dkappa_ = 0, length_ = 0;
};

}  // namespace

SelfDualPoint solve_self_dual(const BlockStructure& structure, BlockCholesky& cholesky,
                              std::span<const double> b, std::span<const double> c) {
  return SelfDualSearch(structure, cholesky, b, c).run();
}

}  // namespace indet::barrier
