#include "libindet/verify/reactions_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "libindet/base/tolerances.h"
#include "libindet/verify/rebuilt_sums.h"

namespace indet {
namespace {

class ReactionCheck {
 public:
  ReactionCheck(const Packing& packing, const ForceRanges& ranges, const RebuiltProblem& problem,
                const ExactAnswers& exact, Comparisons& compare)
      : packing_(packing),
        ranges_(ranges),
        r_(ranges.reactions),
        problem_(problem),
        exact_(exact),
        compare_(compare) {}

  void run() {
    if (r_.count() == 0) return;  // an earlier version, or nothing to bear
    const std::vector<RebuiltSum> sums = rebuilt_sums(packing_);
    if (!compare_.require(static_cast<std::size_t>(r_.count()) == sums.size(),
                          "reactions: {} rows for {} sums", r_.count(), sums.size()))
      return;
    for (Eigen::Index k = 0; k < r_.count(); ++k) {
      const RebuiltSum& sum = sums[static_cast<std::size_t>(k)];
      if (!compare_.require(sum.body.code() == r_.body[k] && sum.component == r_.component[k],
                            "reactions: row {} is not that of body {}, component {}", k, sum.body.code(),
                            sum.component))
        return;
      for (const int end : {0, 1}) check(k, end, sum);
      check_other_states(k, sum);
    }
    compare_.equal_count(r_.states.rows(), next_state_, "reactions: states");
    for (Eigen::Index q = 0; q < r_.rays.rows(); ++q) {
      const Eigen::VectorXd ray = r_.rays.row(q).transpose();
      const double residual = std::max(problem_.imbalance_without_load(ray), problem_.ray_violation(ray));
      compare_.require(residual <= tolerance::kStoredRay, "reactions: ray {} is not one ({})", q, residual);
    }
    if (r_.uncertain() > 0)
      compare_.call_unsolved(fmt::format("{} extrema of reactions uncertain", r_.uncertain()));
    if (ranges_.status != PolytopeStatus::kEmpty)
      compare_.leave_unchecked("lower, upper of /reactions (--exact checks them)");
  }

 private:
  void check(Eigen::Index k, int end, const RebuiltSum& sum) {
    const std::string place = fmt::format("reactions: {} of row {}", end == 0 ? "minimum" : "maximum", k);
    const Outcome outcome = r_.outcome(k, end);
    const double value = r_.value(k, end);
    const int vertex = r_.vertex(k, end);
    const bool has_value = outcome != Outcome::kFailed && outcome != Outcome::kNotRequested;
    compare_.require(has_value != std::isnan(value), "{}: {}, but {} is stored", place, to_string(outcome),
                     value);
    if (std::isnan(value)) return;
    const Outcome other = std::isinf(value) ? Outcome::kOptimal : Outcome::kUnbounded;
    compare_.require(outcome != other, "{}: {}, but {} is stored", place, to_string(outcome), value);
    compare_.require(r_.lower(k, end) <= value && value <= r_.upper(k, end),
                     "{}: the value {} is not within its bounds", place, value);
    if (std::isinf(value)) {
      compare_.require((value > 0) == (end == 1), "{}: wrong sign of infinity", place);
      const int ray = r_.ray(k, end);
      if (compare_.require(ray >= 0, "{}: no ray shows that it is unbounded", place)) {
        compare_.require(sum.coefficients.dot(r_.rays.row(ray).transpose()) * value > 0,
                         "{}: it does not grow along its ray {}", place, ray);
      }
      return;
    }
    if (ranges_.method == Method::kBarrier) {  // enclosed_check.h
      compare_.require(vertex < 0, "{}: an interval with a state", place);
      return;
    }
    if (!compare_.require(vertex == next_state_++, "{}: state {} is not its own", place, vertex)) return;
    compare_.require(r_.ray(k, end) < 0, "{}: a finite value with a ray", place);
    const Eigen::VectorXd forces = r_.states.row(vertex).transpose() / ranges_.force_unit;
    const double scale = std::max(problem_.internal_unit(), forces.lpNorm<Eigen::Infinity>());
    const double found = sum.coefficients.dot(r_.states.row(vertex).transpose());
    const double size = sum.coefficients.cwiseAbs().dot(r_.states.row(vertex).transpose().cwiseAbs());
    compare_.require(std::abs(found - value) <= tolerance::kAgreement * std::max(size, std::abs(value)),
                     "{}: the value {} differs from its state's {}", place, value, found);
    if (outcome != Outcome::kOptimal) return;
    const double violation = std::max(problem_.imbalance(forces), problem_.violation(forces)) / scale;
    compare_.require(violation <= tolerance::kPrimalResidual,
                     "{}: its state violates equilibrium or contact conditions by {}", place, violation);
    std::vector<int> tight;
    for (int h = 0; h < problem_.half_planes(); ++h) {
      if (problem_.slack(h, forces) <= tolerance::kTightHalfPlane * scale) tight.push_back(h);
    }
    const double largest = sum.coefficients.cwiseAbs().maxCoeff();
    const double gap = problem_.optimality_gap(sum.coefficients * ((end == 0 ? -1 : 1) / largest), tight);
    if (gap > tolerance::kOptimalityGap && exact_.agree_on_reaction(k, end)) return;
    compare_.require(gap <= tolerance::kOptimalityGap, "{}: the value {} is not optimal (gap {})", place,
                     value, gap);
  }

  /// No state of the file is outside of the range.
  void check_other_states(Eigen::Index k, const RebuiltSum& sum) {
    for (Eigen::Index row = 0; row < ranges_.states.rows(); ++row) {
      const double value = sum.coefficients.dot(ranges_.states.row(row).transpose());
      const double size = sum.coefficients.cwiseAbs().dot(ranges_.states.row(row).transpose().cwiseAbs());
      const double slack =
          tolerance::kPrimalResidual * std::max(size, problem_.internal_unit() * ranges_.force_unit *
                                                          sum.coefficients.cwiseAbs().maxCoeff());
      const bool outside = (r_.outcome(k, 0) == Outcome::kOptimal && value < r_.lower(k, 0) - slack) ||
                           (r_.outcome(k, 1) == Outcome::kOptimal && value > r_.upper(k, 1) + slack);
      compare_.require(!outside, "reactions: row {} is {} at the extremal state {}, outside of its range", k,
                       value, row);
    }
  }

  const Packing& packing_;
  const ForceRanges& ranges_;
  const Reactions& r_;
  const RebuiltProblem& problem_;
  const ExactAnswers& exact_;
  Comparisons& compare_;
  int next_state_ = 0;  ///< each finite end has a state of its own, in the order of the rows
};

}  // namespace

void check_reactions(const Packing& packing, const ForceRanges& ranges, const RebuiltProblem& problem,
                     const ExactAnswers& exact, Comparisons& compare) {
  ReactionCheck(packing, ranges, problem, exact, compare).run();
}

}  // namespace indet
