#include "libindet/verify/duals_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "libindet/base/counted.h"
#include "libindet/base/tolerances.h"

namespace indet {
namespace {

class DualsCheck {
 public:
  DualsCheck(const ForceRanges& ranges, const RebuiltProblem& problem, Comparisons& compare)
      : ranges_(ranges), duals_(ranges.duals), problem_(problem), compare_(compare) {}

  void run() {
    if (!limit_strengths()) return;
    for (Eigen::Index d = 0; d < duals_.contacts.size(); ++d) {
      for (int column = 0; column < 4; ++column) check(d, column);
    }
    compare_.remark(counted(proven_, "interval") + " proven by stored multipliers and states");
    if (duals_.seed >= 0) compare_.leave_unchecked("/duals@seed (contacts are not drawn again)");
  }

 private:
  /// X; false where ŷ limits nothing.
  bool limit_strengths() {
    if (!compare_.require(duals_.bounding.size() == problem_.scene_rows() && duals_.bounding.allFinite(),
                          "/duals/bounding: not {} numbers", problem_.scene_rows()))
      return false;
    const double total = problem_.load_product(duals_.bounding).value;
    loads_ = problem_.load_product(Eigen::VectorXd::Ones(problem_.scene_rows())).size;
    double least = std::numeric_limits<double>::infinity();
    problem_.for_each_edge(duals_.bounding, [&](int, double, double, const RebuiltProblem::Sum& along) {
      const double rate = along.value - tolerance::kSumOfProof * along.size;
      least = std::min(least, rate);
      strength_.push_back(std::max(0.0, total) / rate);
    });
    return compare_.require(least > 0, "/duals/bounding: it does not limit all forces ({})", least);
  }

  struct Bound {
    double value = 0;     ///< b·y + Σ min(0, h) X, of which
    double rounding = 0;  ///< so much may be rounding
  };
  /// Of the least value of sign · (the force).
  Bound bound_of(int contact, bool tangential, double sign, const Eigen::VectorXd& y) const {
    const RebuiltProblem::Sum load = problem_.load_product(y);
    // Every multiplier carries the rounding of the largest.
    Bound bound{sign * load.value, tolerance::kSumOfProof * loads_ * y.lpNorm<Eigen::Infinity>()};
    std::size_t k = 0;
    problem_.for_each_edge(y, [&](int c, double R, double T, const RebuiltProblem::Sum& along) {
      RebuiltProblem::Sum h;
      if (c == contact) h.add(tangential ? T : R);
      h.value -= along.value;
      const double error = tolerance::kSumOfProof * (h.size + along.size);
      const double X = strength_[k++];
      if (const double worst = sign * h.value - error; worst < 0) {
        const double missing = std::min(0.0, sign * h.value) * X;
        bound.value += missing;
        bound.rounding += error * X;
      }
    });
    return bound;
  }

  void check(Eigen::Index d, int column) {
    const int contact = duals_.contacts[d];
    const Eigen::Index row = Duals::row_of(d, column);
    const double unit = ranges_.force_unit;
    const double lower = ranges_.lower(contact, column) / unit;
    const double upper = ranges_.upper(contact, column) / unit;
    const std::string place = fmt::format("contact {} {}", contact, to_string(static_cast<Column>(column)));
    if (!std::isfinite(lower) || !std::isfinite(upper)) return;
    const bool is_maximum = column == kMaxR || column == kMaxT;
    const Eigen::VectorXd y = duals_.multipliers.row(row).transpose();
    const Eigen::VectorXd point = duals_.points.row(row).transpose() / unit;
    if (!compare_.require(y.allFinite() && point.allFinite(), "{}: its proof has numbers that are none",
                          place))
      return;
    const Bound bound = bound_of(contact, column >= kMinT, is_maximum ? -1 : 1, y);
    double proven = is_maximum ? -bound.value : bound.value;
    if (column == kMinR) proven = std::max(proven, 0.0);  // contacts do not pull
    const bool holds = is_maximum ? upper >= proven - bound.rounding : lower <= proven + bound.rounding;
    const bool is_possible = is_maximum ? proven + bound.rounding >= lower : proven - bound.rounding <= upper;
    bool is_proven = compare_.require(
        holds && is_possible, "{}: between {} and {} mg is stored, but its multipliers prove {} {} mg", place,
        lower, upper, is_maximum ? "at most" : "at least", proven);
    const double allowed =
        tolerance::kPrimalResidual * std::max(problem_.internal_unit(), point.lpNorm<Eigen::Infinity>());
    const double residual = std::max(problem_.imbalance(point), problem_.violation(point));
    is_proven = compare_.require(residual <= allowed,
                                 "{}: the state that proves it violates balance or friction by {} mg", place,
                                 residual) &&
                is_proven;
    const double force = point[2 * contact + (column >= kMinT ? 1 : 0)];
    is_proven = compare_.require(lower - allowed <= force && force <= upper + allowed,
                                 "{}: between {} and {} mg is stored, but the state that proves it has {} mg",
                                 place, lower, upper, force) &&
                is_proven;
    proven_ += is_proven ? 1 : 0;
  }

  const ForceRanges& ranges_;
  const Duals& duals_;
  const RebuiltProblem& problem_;
  Comparisons& compare_;
  std::vector<double> strength_;  ///< X, in the order of the edges
  double loads_ = 0;              ///< Σ |b|
  int proven_ = 0;
};

}  // namespace

void check_duals(const ForceRanges& ranges, const RebuiltProblem& problem, Comparisons& compare) {
  DualsCheck(ranges, problem, compare).run();
}

}  // namespace indet
