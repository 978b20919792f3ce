#include "libindet/verify/reactions_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "libindet/base/tolerances.h"

namespace indet {
namespace {

/// Contact by contact, what a sum adds: (of R, of T).
Vector2 share_of(const Packing& packing, const Contact& contact, Body body, int component) {
  const bool is_a = !body.is_wall() && contact.a == body.disk_id();
  if (!is_a && contact.b != body) return {0, 0};
  Vector2 share(0, 0);
  if (body.is_wall()) {
    share[component] = 1;
  } else if (component == 2) {
    const double lever = is_a ? contact.lever_a : contact.lever_b;
    share.y() = std::isnan(lever) ? packing[body.disk_id()].radius : lever;
  } else {
    const Vector2 tangent(contact.normal.y(), -contact.normal.x());
    share = Vector2(contact.normal[component], tangent[component]) * (is_a ? 1 : -1);
  }
  if (contact.mu == 0) share.y() = 0;
  return share;
}

struct Sum {
  Body body;
  int component = 0;
  Eigen::VectorXd coefficients;
};

std::vector<Sum> sums_of(const Packing& packing) {
  std::vector<Sum> sums;
  const auto add = [&](Body body, int components) {
    for (int k = 0; k < components; ++k) {
      Sum sum{body, k, Eigen::VectorXd(2 * packing.contact_count())};
      for (int i = 0; i < packing.contact_count(); ++i)
        sum.coefficients.segment<2>(2 * i) = share_of(packing, packing[ContactId(i)], body, k);
      if (sum.coefficients.size() > 0 && sum.coefficients.cwiseAbs().maxCoeff() > 0)
        sums.push_back(std::move(sum));
    }
  };
  for (int w = 0; w < packing.wall_count(); ++w) add(Body::wall(WallId(w)), 2);
  for (int i = 0; i < packing.disk_count(); ++i) {
    if (packing[DiskId(i)].fixed) add(Body::disk(DiskId(i)), 3);
  }
  return sums;
}

class ReactionCheck {
 public:
  ReactionCheck(const Packing& packing, const ForceRanges& ranges, const RebuiltProblem& problem,
                Comparisons& compare)
      : packing_(packing), ranges_(ranges), r_(ranges.reactions), problem_(problem), compare_(compare) {}

  void run() {
    if (r_.count() == 0) return;  // an earlier version, or nothing to bear
    const std::vector<Sum> sums = sums_of(packing_);
    if (!compare_.require(static_cast<std::size_t>(r_.count()) == sums.size(),
                          "reactions: {} rows for {} sums", r_.count(), sums.size()))
      return;
    for (Eigen::Index k = 0; k < r_.count(); ++k) {
      const Sum& sum = sums[static_cast<std::size_t>(k)];
      if (!compare_.require(sum.body.code() == r_.body[k] && sum.component == r_.component[k],
                            "reactions: row {} is not that of body {}, component {}", k, sum.body.code(),
                            sum.component))
        return;
      for (const int end : {0, 1}) check(k, end, sum);
      check_other_states(k, sum);
    }
  }

 private:
  void check(Eigen::Index k, int end, const Sum& sum) {
    const std::string place = fmt::format("reactions: {} of row {}", end == 0 ? "minimum" : "maximum", k);
    const Outcome outcome = r_.outcome(k, end);
    const double value = r_.value(k, end);
    const int vertex = r_.vertex(k, end);
    const bool has_value =
        outcome == Outcome::kOptimal || outcome == Outcome::kImprecise || outcome == Outcome::kUnbounded;
    compare_.require(has_value != std::isnan(value), "{}: {}, but {} is stored", place, to_string(outcome),
                     value);
    compare_.require(!ranges_.doubtful || (outcome != Outcome::kOptimal && outcome != Outcome::kUnbounded),
                     "{}: certified, though the polytope is in doubt", place);
    if (std::isnan(value)) return;
    compare_.require(r_.lower(k, end) <= value && value <= r_.upper(k, end),
                     "{}: the value {} is not within its bounds", place, value);
    if (std::isinf(value)) {
      compare_.require((value > 0) == (end == 1), "{}: wrong sign of infinity", place);
      return;
    }
    if (!compare_.require(vertex >= 0, "{}: there is no state", place)) return;
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
    compare_.require(gap <= tolerance::kOptimalityGap, "{}: the value {} is not optimal (gap {})", place,
                     value, gap);
  }

  /// No state of the file is outside of the range.
  void check_other_states(Eigen::Index k, const Sum& sum) {
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
  Comparisons& compare_;
};

}  // namespace

void check_reactions(const Packing& packing, const ForceRanges& ranges, const RebuiltProblem& problem,
                     Comparisons& compare) {
  ReactionCheck(packing, ranges, problem, compare).run();
}

}  // namespace indet
