#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "libindet/exact/optimum.h"

namespace indet::exact {

/// Counts exact solves, weighted by size, against a limit: so the same decisions are settled on every
/// machine.
class Work {
 public:
  /// `limit`: in squares of the number of equations, summed over solves (a solve costs at least 1e3).
  Work(const ContactProblem& problem, double limit);

  /// Pivots that are left, at most `most`.
  int pivots(int most) const;
  /// Counts a walk of so many pivots.
  void add(int pivots) { done_ += (pivots + 1) * solve_; }
  bool is_over() const { return done_ > limit_; }

 private:
  double solve_, limit_;
  double done_ = 0;
};

/// What the polytope F of admissible states is, over the rational numbers.
struct Structure {
  /// kOptimal: there are states. kEmpty, kInconsistent: there is none, and `motion` proves it.
  Verdict verdict = Verdict::kUndecided;
  std::vector<double> motion;  ///< ContactBasis::falling_motion or contradiction
  /// The problem with the edges alone that have a strength in some state: F has full dimension in it.
  std::shared_ptr<const ContactProblem> open;
  std::shared_ptr<const ContactBasis> state;  ///< a feasible basis of `open`
  int dim = -1;                               ///< number of open edges − their rank
  /// Independent parts of F (ForcePolytope::blocks): a cross product of polytopes, one for each set of edges
  /// that some circuit of their columns connects; edges of a contact go together.
  int parts = 0;
};

/// Whether all strengths are limited; nothing if the limit of work was reached. Precondition: there are
/// states.
std::optional<bool> is_bounded(const Structure& structure, Work& work);

/// Decides from a basis. `known`: further ones, of which those that are feasible show edges that are open.
/// kUndecided: the limit of work was reached. Walks are proven; of the rank see ContactProblem::rank(), and
/// parts are found modulo the same prime.
Structure find_structure(const ContactProblem& problem, std::shared_ptr<const ContactBasis> start, Work& work,
                         std::span<const std::shared_ptr<const ContactBasis>> known = {});

}  // namespace indet::exact
