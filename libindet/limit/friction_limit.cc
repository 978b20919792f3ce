#include "libindet/limit/friction_limit.h"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>

#include "libindet/base/constants.h"
#include "libindet/base/tolerances.h"
#include "libindet/equilibrium/contact_state.h"
#include "libindet/limit/exact_basis.h"
#include "libindet/limit/limit_program.h"
#include "libindet/limit/mechanism.h"
#include "libindet/limit/standing.h"

namespace indet {
namespace {

using exact::ContactProblem;
using exact::Goal;
using exact::Optimum;
using exact::Verdict;

using tolerance::kLargestFactor;
using tolerance::kSmallestFactor;

/// −A w, with w what a strength of 1 in the exact problem is here.
Eigen::VectorXd relaxation(const EquilibriumProblem& problem) {
  Eigen::VectorXd weights(problem.unknowns());
  for (int k = 0; k < problem.unknowns(); ++k)
    weights[k] = problem.edge(k).is_slack() ? 0 : 1 / problem.edge(k).R;
  return -(problem.edge_matrix * weights);
}

class FrictionFinder {
 public:
  FrictionFinder(const Packing& packing, const std::vector<bool>& scaled, const LimitOptions& options)
      : packing_(packing), scaled_(scaled), options_(options) {}

  FrictionLimit find() {
    const Standing without = stand(0);
    if (without.stands()) {
      describe_state(without, 0);
      end_.outcome = LimitOutcome::kReached;
      end_.value = end_.lower = end_.upper = 0;
      return finish();
    }
    double high = 1;
    while (falls_at(high) && high < kLargestFactor) high *= high < 16 ? 2 : 16;
    if (falls_at(high)) {
      describe_hopeless(high);
      return finish();
    }
    double low = high;
    while (!falls_at(low) && low > kSmallestFactor) low /= low > 1.0 / 16 ? 2 : 16;
    if (!falls_at(low)) {
      describe_any(low, without);
      return finish();
    }
    if (margin(low) < 0 && margin(high) > 0) {
      const double zero = zero_between(low, high);
      for (double share = tolerance::kFrictionFactor / 2; share < tolerance::kLimitWidth / 2; share *= 10) {
        if (enclose(zero, share)) break;
      }
    }
    if (end_.outcome != LimitOutcome::kReached) bisect(low, high);
    if (end_.outcome == LimitOutcome::kReached) result_.is_attained = !grows();
    return finish();
  }

 private:
  Packing at(double factor) const { return with_friction(packing_, scaled_, factor); }
  Standing stand(double factor) { return find_standing(at(factor), options_); }

  /// Where t is near 0 for GLPK, as where some edges are closed with any friction, or far from 1, where its
  /// tolerances say little, exact arithmetic has the last word.
  bool falls_at(double factor) {
    using tolerance::kFarFactor;
    const double t = margin(factor);
    if (std::abs(t) > tolerance::kClearMargin && factor < kFarFactor && factor > 1 / kFarFactor) return t < 0;
    return !stand(factor).stands();
  }

  /// The largest t with x ≥ t, as GLPK tells; −1 where no forces balance the load, 1 where t has no limit.
  double margin(double factor) {
    const LimitProgram::Answer answer = relaxed_at(factor);
    if (answer.status == LpStatus::kUnbounded) return 1;
    return answer.status == LpStatus::kOptimal ? answer.lambda : -1;
  }

  /// The linear program of the relaxed problem, from where the last one ended.
  LimitProgram::Answer relaxed_at(double factor) {
    problem_ = pose_equilibrium(at(factor));
    if (program_)
      program_->replace(problem_, relaxation(problem_));
    else
      program_ = std::make_unique<LimitProgram>(problem_, relaxation(problem_));
    return program_->find(1);
  }

  double zero_between(double low, double high) {
    std::uintmax_t most = 100;
    const auto is_close = [](double a, double b) {
      return std::abs(b - a) <= tolerance::kFrictionFactor / 4 * std::abs(b);
    };
    const auto [a, b] =
        boost::math::tools::toms748_solve([this](double s) { return margin(s); }, low, high, is_close, most);
    return (a + b) / 2;
  }

  /// Whether it falls this share below, and stands this share above.
  bool enclose(double zero, double share) {
    const double below = zero * (1 - share);
    const double above = zero * (1 + share);
    const Standing standing = stand(above);
    if (!standing.stands() || !prove_fall(below)) return false;
    describe_state(standing, zero);
    end_.outcome = LimitOutcome::kReached;
    end_.value = zero;
    end_.lower = below;
    end_.upper = above;
    return true;
  }

  /// By halves, with exact arithmetic alone. It falls at `low` and stands at `high`.
  void bisect(double low, double high) {
    while (high - low > tolerance::kFrictionFactor * high) {
      const double middle = std::midpoint(low, high);
      const Standing there = stand(middle);
      if (!there.stands() && !there.falls()) return;
      (there.stands() ? high : low) = middle;
    }
    const Standing below = stand(low);
    const Standing above = stand(high);
    if (!below.falls() || !above.stands()) return;
    describe_state(above, high);
    end_.motion = below.motion;
    end_.outcome = LimitOutcome::kReached;
    end_.lower = low;
    end_.upper = high;
    end_.value = high;
  }

  /// The largest t is negative, and the motion that proves it is stored.
  bool prove_fall(double factor) {
    const Packing there = at(factor);
    const ContactProblem exact = ContactProblem::relaxed(there);
    const LimitProgram::Answer answer = relaxed_at(factor);
    const auto basis = basis_of(exact, problem_, answer);
    if (!basis) return false;
    const Goal goal = Goal::of_strengths({{exact.rise(), 1.0}, {exact.fall(), -1.0}});
    const Optimum found = exact::maximise(exact, basis, goal, options_.most_pivots);
    switch (found.verdict) {
      case Verdict::kOptimal:
        if (found.value >= 0) return false;
        end_.motion = exact::on_bodies(there, exact, found.basis->motion(*found.multipliers));
        return true;
      case Verdict::kInconsistent:  // whatever the signs of strengths are
        end_.motion = exact::on_bodies(there, exact, *found.basis->contradiction());
        is_inconsistent_ = true;
        return true;
      default:
        return false;
    }
  }

  /// As far as one can see any friction will do, but none will not.
  void describe_any(double factor, const Standing& without) {
    const Standing standing = stand(factor);
    if (!standing.stands() || !without.falls()) return;
    describe_state(standing, factor);
    end_.motion = without.motion;
    end_.outcome = LimitOutcome::kReached;
    end_.value = end_.lower = 0;
    end_.upper = factor;
    result_.is_attained = false;
  }

  /// No factor up to a large one suffices; where equations contradict each other, none at all does.
  void describe_hopeless(double factor) {
    if (!prove_fall(factor)) return;
    end_.outcome = LimitOutcome::kNoState;
    end_.value = kInfinity;
    end_.lower = is_inconsistent_ ? kInfinity : factor;
  }

  /// Whether forces grow without limit as the factor falls to the infimum: a thousand times closer to it they
  /// are much larger.
  bool grows() {
    constexpr double kShare = 1e-6;
    const Standing far = stand(end_.value * (1 + kShare));
    const Standing near = stand(end_.value * (1 + kShare / 1000));
    if (!far.stands() || !near.stands()) return false;
    return near.forces.value().lpNorm<Eigen::Infinity>() > 100 * far.forces.value().lpNorm<Eigen::Infinity>();
  }

  /// Its state is one just above the infimum, where contacts that slide at it do so but for some 1e-12.
  void describe_state(const Standing& standing, double factor) {
    end_.forces = standing.forces;
    const CoulombCount count = count_coulomb(at(factor), standing.forces, tolerance::kSliding);
    end_.sliding = count.sliding;
    end_.non_transmitting = count.non_transmitting;
  }
  FrictionLimit finish() {
    result_.infimum = std::move(end_);
    return std::move(result_);
  }

  const Packing& packing_;
  const std::vector<bool>& scaled_;
  LimitOptions options_;
  EquilibriumProblem problem_;  ///< with the friction that was asked about last
  std::unique_ptr<LimitProgram> program_;
  LimitEnd end_;
  FrictionLimit result_;
  bool is_inconsistent_ = false;  ///< the equations contradict each other, whatever the forces
};

}  // namespace

Packing with_friction(Packing packing, const std::vector<bool>& scaled, double factor) {
  for (std::size_t i = 0; i < packing.contacts.size(); ++i) {
    if (scaled[i]) packing.contacts[i].mu *= factor;
  }
  return packing;
}

FrictionLimit find_friction_limit(const Packing& packing, const std::vector<bool>& scaled,
                                  const LimitOptions& options) {
  return FrictionFinder(packing, scaled, options).find();
}

}  // namespace indet
