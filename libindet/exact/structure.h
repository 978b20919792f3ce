#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "libindet/exact/optimum.h"
#include "libindet/exact/work.h"

namespace indet::exact {

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
