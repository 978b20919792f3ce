#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "libindet/exact/optimum.h"

namespace indet::exact {

/// The extremum of a goal with the canonical one of the states that attain it.
struct ExtremalState {
  Optimum optimum;
  bool unique = false;                        ///< one state alone attains it
  std::shared_ptr<const ContactBasis> state;  ///< null where there is none, or the limit was reached
  int pivots = 0;                             ///< of all walks
};

/// Finds extremal states over a polytope. The canonical one is that of smallest ΣR, and of several that of a
/// smallest sum with fixed weights (docs/decisions/canonical-states.md).
class ExtremalStates {
 public:
  /// `problem`: of open edges alone (Structure::open); must outlive this.
  explicit ExtremalStates(const ContactProblem& problem);

  /// `start`: a feasible basis; no walk takes more than `limit` pivots.
  ExtremalState find(const Goal& goal, std::shared_ptr<const ContactBasis> start, int limit) const;

 private:
  using Face = std::vector<bool>;
  std::optional<bool> has_one_state(const std::shared_ptr<const ContactBasis>& basis, const Face& face,
                                    int limit, int& pivots) const;
  std::shared_ptr<const ContactBasis> canonical(const std::shared_ptr<const ContactBasis>& start,
                                                const Face& face, int limit, int& pivots) const;

  const ContactProblem& problem_;
  Goal lightness_, generic_;
};

}  // namespace indet::exact
