#include "libindet/limit/load_limits.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "libindet/base/constants.h"
#include "libindet/exact/structure.h"
#include "libindet/limit/exact_basis.h"
#include "libindet/limit/limit_program.h"
#include "libindet/limit/standing.h"

namespace indet {
namespace {

using exact::ContactBasis;
using exact::ContactProblem;
using exact::Goal;
using exact::Optimum;
using exact::Verdict;
using SharedBasis = std::shared_ptr<const ContactBasis>;

/// The packing with nothing but ± the change acting on it, and bounds as they are for a direction of growth.
Packing under_change_alone(const Packing& packing, const Loads& change, int sign) {
  Packing alone = under_alone(combined(sign, change, 0, {}), packing);
  const auto to_zero = [](double& bound) { bound = std::isfinite(bound) ? 0 : bound; };
  for (Contact& contact : alone.contacts) {
    for (double* bound : {&contact.R_lo, &contact.R_hi, &contact.T_lo, &contact.T_hi}) to_zero(*bound);
  }
  return alone;
}

}  // namespace

struct LoadLimitFinder::Impl {
  Impl(const Packing& packing, const Loads& change, const LimitOptions& options)
      : packing_(packing),
        change_(change),
        options_(options),
        problem_(pose_equilibrium(packing, natural_modes(packing), {&change, 1})),
        exact_(packing, change),
        program_(problem_) {}

  LimitEnd find(int sign) {
    LimitEnd end;
    const LimitProgram::Answer answer = program_.find(sign);
    if (answer.status == LpStatus::kUnbounded && !prove_some_state(answer, end)) return end;
    if (answer.status == LpStatus::kUnbounded && prove_never(sign, end)) return end;
    prove(answer, sign, end);
    return end;
  }

  /// Some λ has a state. If none has, or that is not decided, the end says so.
  bool prove_some_state(const LimitProgram::Answer& answer, LimitEnd& end) const {
    const SharedBasis basis = basis_of(exact_, problem_, answer);
    if (!basis) return false;
    const Optimum found = exact::find_solution(exact_, basis, options_.most_pivots);
    if (found.verdict == Verdict::kOptimal) return true;
    describe_fall(found, end);
    return false;
  }

  /// No λ has a state, if that was found.
  void describe_fall(const Optimum& found, LimitEnd& end) const {
    if (found.verdict != Verdict::kEmpty && found.verdict != Verdict::kInconsistent) return;
    end.outcome = LimitOutcome::kNoState;
    end.motion = exact::on_bodies(packing_, exact_,
                                  found.verdict == Verdict::kEmpty ? found.basis->falling_motion(found.edge)
                                                                   : *found.basis->contradiction());
  }

  /// The change alone is balanced by admissible forces, so that any state can take any multiple of it.
  bool prove_never(int sign, LimitEnd& end) const {
    const Packing alone = under_change_alone(packing_, change_, sign);
    const Standing standing = find_standing(alone, options_);
    if (!standing.stands()) return false;
    end.outcome = LimitOutcome::kNever;
    end.value = sign * kInfinity;
    end.lower = sign > 0 ? kInfinity : -kInfinity;
    end.upper = end.lower;
    const Eigen::VectorXd& forces = standing.forces.value();
    const double largest = forces.lpNorm<Eigen::Infinity>();
    end.forces = SceneForces(largest > 0 ? Eigen::VectorXd(forces / largest) : forces);
    return true;
  }

  void prove(const LimitProgram::Answer& answer, int sign, LimitEnd& end) const {
    const SharedBasis basis = basis_of(exact_, problem_, answer);
    if (!basis) return;
    const Goal goal = Goal::of_strengths({{exact_.rise(), 1.0 * sign}, {exact_.fall(), -1.0 * sign}});
    const Optimum found = exact::maximise(exact_, basis, goal, options_.most_pivots);
    if (found.verdict == Verdict::kOptimal) {
      describe(found, goal, sign, end);
    } else if (found.verdict == Verdict::kUnbounded) {
      if (prove_some_state(answer, end)) prove_never(sign, end);
    } else {
      describe_fall(found, end);
    }
  }

  void describe(const Optimum& found, const Goal& goal, int sign, LimitEnd& end) const {
    const ContactBasis& basis = *found.basis;
    const mpq_class value = sign * found.value;
    const exact::Enclosure bounds = exact::enclose(value);
    end.outcome = LimitOutcome::kReached;
    end.value = exact::nearest(value);
    end.lower = bounds.lower;
    end.upper = bounds.upper;
    end.forces = forces_of(basis, packing_.contact_count());
    end.motion = exact::on_bodies(packing_, exact_, basis.motion(*found.multipliers));
    const ClosedContacts closed = closed_contacts(exact_, basis);
    end.sliding = closed.edges;
    end.non_transmitting = closed.contacts;
    describe_face(found, goal, end);
  }

  /// What of F is left at the limit: without edges that work against the mechanism.
  void describe_face(const Optimum& found, const Goal& goal, LimitEnd& end) const {
    std::vector<bool> face = found.basis->optimal_face(goal, *found.multipliers);
    for (const int lambda : {exact_.rise(), exact_.fall()}) {  // λ does not change in it
      if (!found.basis->is_basic(lambda)) face[static_cast<std::size_t>(lambda)] = false;
    }
    const auto is_positive = [&](int e) { return found.basis->sign_of_strength(e) > 0; };
    const std::vector<int>& edges = found.basis->edges();
    if (std::all_of(edges.begin(), edges.end(), is_positive)) {  // each edge outside can grow from 0
      end.dim = static_cast<int>(found.basis->outside(face).size());
      end.has_one_mechanism = true;
      return;
    }
    const ContactProblem at_limit = exact_.restricted_to(face);
    exact::Work work(at_limit, options_.face_work);
    constexpr int kLeastPivots = 20;  // else it would not come far
    if (work.pivots() < kLeastPivots) return;
    const SharedBasis start = ContactBasis::create(at_limit, found.basis->edges());
    if (!start) return;
    const exact::Structure left = exact::find_structure(at_limit, start, work);
    if (left.verdict != Verdict::kOptimal) return;
    end.dim = left.dim;
    end.has_one_mechanism = left.open->rank() == exact_.rank();
  }

  const Packing& packing_;
  const Loads& change_;
  LimitOptions options_;
  EquilibriumProblem problem_;
  ContactProblem exact_;
  LimitProgram program_;
};

LoadLimitFinder::LoadLimitFinder(const Packing& packing, const Loads& change, const LimitOptions& options)
    : impl_(std::make_unique<Impl>(packing, change, options)) {}
LoadLimitFinder::~LoadLimitFinder() = default;

LimitEnd LoadLimitFinder::find(int sign) { return impl_->find(sign); }

const char* to_string(LimitOutcome outcome) {
  switch (outcome) {
    case LimitOutcome::kReached:
      return "reached";
    case LimitOutcome::kNever:
      return "never";
    case LimitOutcome::kNoState:
      return "no state";
    case LimitOutcome::kUndecided:
      return "undecided";
  }
  return "?";
}

bool LoadLimits::contains(double lambda) const { return smallest.upper <= lambda && lambda <= largest.lower; }

LoadLimits find_load_limits(const Packing& packing, const Loads& change, const LimitOptions& options) {
  LoadLimitFinder finder(packing, change, options);
  LoadLimits limits;
  limits.largest = finder.find(1);
  limits.smallest = finder.find(-1);
  return limits;
}

}  // namespace indet
