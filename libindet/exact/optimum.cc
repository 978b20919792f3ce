#include "libindet/exact/optimum.h"

namespace indet::exact {
namespace {

/// Criss-cross steps up to a feasible basis, and primal ones from there; `goal` absent: any feasible basis
/// will do.
Optimum walk(const ContactProblem& problem, std::shared_ptr<const ContactBasis> basis,
             const std::optional<Goal>& goal, int pivot_limit, const std::vector<bool>& face) {
  Optimum result;
  for (;; ++result.pivots) {
    result.basis = basis;
    if (!basis->is_balanced()) {
      if (basis->contradiction()) result.verdict = Verdict::kInconsistent;
      return result;
    }
    const int infeasible = basis->first_negative();
    if (goal) result.multipliers = std::make_shared<ContactBasis::Multipliers>(basis->multipliers(*goal));
    const int improving = goal ? basis->first_improving(*goal, *result.multipliers, face) : -1;
    if (infeasible < 0 && improving < 0) {
      result.verdict = Verdict::kOptimal;
      if (goal) result.value = basis->stand_in(*goal);
      return result;
    }
    const bool leave = improving < 0 || (infeasible >= 0 && infeasible < improving);
    const int partner = leave            ? basis->first_raising(infeasible, face)
                        : infeasible < 0 ? basis->first_vanishing(improving)
                                         : basis->first_blocking(improving);
    if (partner < 0) {
      result.verdict = leave ? Verdict::kEmpty : Verdict::kUnbounded;
      result.edge = leave ? infeasible : improving;
      return result;
    }
    if (result.pivots == pivot_limit) return result;
    const int leaving = leave ? infeasible : partner;
    const int entering = leave ? partner : improving;
    std::vector<int> edges = basis->edges();
    std::erase(edges, leaving);
    edges.push_back(entering);
    basis = ContactBasis::create(problem, std::move(edges));
    if (!basis) return result;  // singular modulo several primes: no claim
  }
}

}  // namespace

Optimum maximise(const ContactProblem& problem, std::shared_ptr<const ContactBasis> start, const Goal& goal,
                 int pivot_limit, const std::vector<bool>& face) {
  return walk(problem, std::move(start), goal, pivot_limit, face);
}

Optimum find_solution(const ContactProblem& problem, std::shared_ptr<const ContactBasis> start,
                      int pivot_limit) {
  return walk(problem, std::move(start), {}, pivot_limit, {});
}

}  // namespace indet::exact
