#include "libindet/barrier/analytic_centre.h"

#include <algorithm>
#include <cmath>

#include "libindet/barrier/vectors.h"
#include "libindet/base/tolerances.h"

namespace indet::barrier {
namespace {

/// The iteration for x, y and s = −Aᵀ y (here y is minus that of the header, so that s > 0), towards x s = 1.
class CentreSearch {
 public:
  CentreSearch(const BlockStructure& structure, BlockCholesky& cholesky)
      : structure_(structure),
        cholesky_(cholesky),
        n_(static_cast<std::size_t>(structure.columns())),
        x_(n_, kFirst),
        s_(n_, 1 / kFirst),
        y_(static_cast<std::size_t>(structure.rows()), 0.0),
        D_(n_) {}

  AnalyticCentre run() {
    AnalyticCentre centre;
    for (; centre.iterations < kMostIterations; ++centre.iterations) {
      find_residuals();
      if (!std::isfinite(largest_entry(primal_)) || largest_entry(x_) > tolerance::kFarthestCentre) break;
      if (is_centred()) {
        centre.found = true;
        break;
      }
      step();
    }
    centre.x = x_;
    centre.y = y_;
    for (double& value : centre.y) value = -value;
    return centre;
  }

 private:
  static constexpr double kFirst = 10;  ///< strengths at the start; of little influence
  static constexpr int kMostIterations = 200;
  static constexpr double kShare = 0.9;  ///< of the way to the nearest bound

  void find_residuals() {
    primal_ = product(structure_, x_);
    for (std::size_t i = 0; i < primal_.size(); ++i) primal_[i] = structure_.load()[i] - primal_[i];
    dual_ = transposed_product(structure_, y_);
    for (std::size_t k = 0; k < n_; ++k) dual_[k] = -(s_[k] + dual_[k]);
  }

  bool is_centred() const {
    if (largest_entry(primal_) > tolerance::kCentreBalance * std::max(1.0, largest_entry(x_))) return false;
    for (std::size_t k = 0; k < n_; ++k) {
      if (std::abs(dual_[k]) * x_[k] > tolerance::kCentring ||
          std::abs(x_[k] * s_[k] - 1) > tolerance::kCentring)
        return false;
    }
    return true;
  }

  void step() {
    for (std::size_t k = 0; k < n_; ++k) D_[k] = x_[k] / s_[k];
    cholesky_.factor(D_);
    std::vector<double> second_order(n_, 0.0);
    std::vector<double> dx(n_), ds(n_), dy;
    double primal_step = 0, dual_step = 0;
    for (const bool corrects : {false, true}) {
      std::vector<double> t(n_);
      for (std::size_t k = 0; k < n_; ++k)
        t[k] = (1 - x_[k] * s_[k] - second_order[k]) / s_[k] - D_[k] * dual_[k];
      dy = product(structure_, t);
      for (std::size_t i = 0; i < dy.size(); ++i) dy[i] = primal_[i] - dy[i];
      cholesky_.solve(dy);
      const std::vector<double> along = transposed_product(structure_, dy);
      primal_step = dual_step = 1 / kShare;
      for (std::size_t k = 0; k < n_; ++k) {
        ds[k] = dual_[k] - along[k];
        dx[k] = t[k] + D_[k] * along[k];
        if (dx[k] < 0) primal_step = std::min(primal_step, -x_[k] / dx[k]);
        if (ds[k] < 0) dual_step = std::min(dual_step, -s_[k] / ds[k]);
      }
      primal_step = std::min(1.0, kShare * primal_step);
      dual_step = std::min(1.0, kShare * dual_step);
      if (corrects) break;
      for (std::size_t k = 0; k < n_; ++k)
        second_order[k] = std::clamp(primal_step * dual_step * dx[k] * ds[k], -1.0, 1.0);
    }
    for (std::size_t k = 0; k < n_; ++k) {
      x_[k] += primal_step * dx[k];
      s_[k] += dual_step * ds[k];
    }
    for (std::size_t i = 0; i < y_.size(); ++i) y_[i] += dual_step * dy[i];
  }

  const BlockStructure& structure_;
  BlockCholesky& cholesky_;
  std::size_t n_;
  std::vector<double> x_, s_, y_, D_;
  std::vector<double> primal_, dual_;  ///< b − A x, −(s + Aᵀ y)
};

}  // namespace

AnalyticCentre find_analytic_centre(const BlockStructure& structure, BlockCholesky& cholesky) {
  return CentreSearch(structure, cholesky).run();
}

}  // namespace indet::barrier
