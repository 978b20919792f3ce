#include "libindet/verify/kept_states_check.h"

#include <algorithm>
#include <cmath>

#include "libindet/base/constants.h"
#include "libindet/base/tolerances.h"

namespace indet {
namespace {

/// No contact that was left out is larger than one that was kept.
void check_largest(const ForceRanges& ranges, Comparisons& compare) {
  double least_kept = kInfinity;
  double largest_left = -kInfinity;
  for (Eigen::Index i = 0; i < ranges.value.rows(); ++i) {
    const auto value = ranges.value.row(i);
    const double size = value[kMaxR] - value[kMinR] + value[kMaxT] - value[kMinT];
    if (ranges.keeps(static_cast<int>(i))) {
      compare.require(!std::isnan(size), "contacts: {} has no size", i);
      least_kept = std::fmin(least_kept, size);
    } else {
      largest_left = std::fmax(largest_left, size);
    }
  }
  compare.require(least_kept >= largest_left, "contacts: they are not those of largest delta_R + delta_T");
}

}  // namespace

void check_kept_states(const ForceRanges& ranges, Comparisons& compare) {
  const auto& contacts = ranges.state_contacts;
  const bool is_all = ranges.states_of == StateChoice::Contacts::kAll;
  compare.require(is_all == (contacts.size() == 0), "contacts: {} are named, but the states kept are of {}",
                  contacts.size(), to_string(ranges.states_of));
  for (Eigen::Index k = 0; k < contacts.size(); ++k) {
    const bool is_ascending = k == 0 || contacts[k - 1] < contacts[k];
    compare.require(contacts[k] >= 0 && is_ascending, "contacts: {} is out of order", contacts[k]);
  }
  for (Eigen::Index i = 0; i < ranges.vertex.rows(); ++i) {
    const bool has_state = (ranges.vertex.row(i) >= 0).any();
    compare.require(!has_state || ranges.keeps(static_cast<int>(i)),
                    "contact {}: it has states, though none of it are said to be kept", i);
  }
  if (ranges.states_of == StateChoice::Contacts::kLargest) check_largest(ranges, compare);
}

void check_without_state(const ForceRanges& ranges, int contact, int column, const std::string& place,
                         Comparisons& compare) {
  const bool is_enclosed =
      std::isfinite(ranges.lower(contact, column)) && std::isfinite(ranges.upper(contact, column));
  compare.require(std::isfinite(ranges.value(contact, column)), "{}: {}, but no value is stored", place,
                  to_string(ranges.outcome(contact, column)));
  compare.require(!ranges.keeps(contact) || is_enclosed,
                  "{}: it has neither a state nor bounds, though the states of its contact are kept", place);
  if (ranges.outcome(contact, column) != Outcome::kOptimal) return;
  const double primal = ranges.primal_residual(contact, column);
  const double dual = ranges.dual_residual(contact, column);
  compare.require(primal <= tolerance::kPrimalResidual, "{}: primal residual {} of a certified value", place,
                  primal);
  compare.require(dual <= tolerance::kDualResidual, "{}: dual residual {} of a certified value", place, dual);
}

}  // namespace indet
