#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "libindet/exact/contact_basis.h"
#include "libindet/exact/enclosure.h"

namespace indet::exact {

/// What exact arithmetic proves about one objective.
enum class Verdict : std::uint8_t {
  kOptimal,       ///< the basis is feasible and no edge improves it
  kUnbounded,     ///< a ray of the recession cone improves the objective without limit (and a feasible basis
                  ///< exists)
  kEmpty,         ///< Farkas: no forces satisfy the conditions
  kInconsistent,  ///< some equations contradict each other, whatever the forces
  kUndecided      ///< the limit of pivots was reached
};

struct Optimum {
  Verdict verdict = Verdict::kUndecided;
  mpq_class value;  ///< if optimal: stands for the goal's sum itself, not times the sign (stand_in())
  int pivots = 0;   ///< 0: the start was it
  /// Of `basis`: if unbounded, the edge with which the goal grows (ContactBasis::ray); if empty, the one that
  /// nothing can raise (ContactBasis::falling_motion).
  int edge = -1;
  std::shared_ptr<const ContactBasis> basis;
  std::shared_ptr<const ContactBasis::Multipliers> multipliers;  ///< of `basis`, if optimal with a goal

  /// Whether of these forces and multipliers some were needed as rational numbers so far.
  bool is_rational() const { return basis->is_rational() || (multipliers && multipliers->y.is_rational()); }
};

/// Maximises a goal from a basis, by the criss-cross method with least indices (Terlaky,
/// Optimization 16, 683 (1985)): it needs no feasible start, takes no step by rounding, and is finite. A
/// basis that is optimal already costs no pivot. kUnbounded is reported as "dual infeasible": the ray exists;
/// that the problem has a solution is for the caller to know, or to ask with find_solution.
/// `face`: where it is not empty, edges that are not set in it are held at 0; the start's are.
Optimum maximise(const ContactProblem& problem, std::shared_ptr<const ContactBasis> start, const Goal& goal,
                 int pivot_limit, const std::vector<bool>& face = {});

/// A feasible basis (kOptimal), or the proof that there is none (kEmpty, kInconsistent).
Optimum find_solution(const ContactProblem& problem, std::shared_ptr<const ContactBasis> start,
                      int pivot_limit);

}  // namespace indet::exact
