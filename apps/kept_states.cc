#include "apps/kept_states.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>

#include "libindet/base/counted.h"
#include "libindet/range/state_choice.h"

namespace indet::app {
namespace {

using Kind = StateChoice::Kind;
using Contacts = StateChoice::Contacts;

/// "of 3 contacts", "of the 3 contacts of largest δR + δT", "".
std::string describe_contacts(const KeptStates& kept) {
  if (kept.states_of == Contacts::kAll) return "";
  const std::string contacts = counted(kept.state_contacts.size(), "contact");
  return kept.states_of == Contacts::kList ? " of " + contacts
                                           : fmt::format(" of the {} of largest δR + δT", contacts);
}

/// Values of contacts whose states are kept that have none.
std::int64_t values_without_state(const ForceRanges& ranges) {
  std::int64_t count = 0;
  for (Eigen::Index i = 0; i < ranges.value.rows(); ++i) {
    if (!ranges.keeps(static_cast<int>(i))) continue;
    for (int column = 0; column < 4; ++column)
      count += std::isfinite(ranges.value(i, column)) && ranges.vertex(i, column) < 0 ? 1 : 0;
  }
  return count;
}

}  // namespace

std::string describe_kept_states(const ForceRanges& ranges) {
  if (ranges.state_kind == Kind::kNone) {
    const int asked_for = ranges.requested;
    const auto contacts = static_cast<int>(ranges.value.rows());
    const double megabytes = 1e-6 * static_cast<double>(largest_state_bytes(asked_for, contacts));
    return fmt::format(
        "no extremal states kept (all could take {:.3g} MB; --extremal-states canonical keeps them)",
        megabytes);
  }
  const char* const which = ranges.state_kind == Kind::kCanonical ? ", the canonical ones"
                            : ranges.state_kind == Kind::kSolver  ? ", those that the solver found"
                                                                  : "";
  const std::int64_t without = values_without_state(ranges);
  return fmt::format(
      "{} kept{}{}{}", counted(ranges.states.rows(), "extremal state"), which, describe_contacts(ranges),
      without > 0 ? fmt::format("; {} without one, as none was proven", counted(without, "value")) : "");
}

std::string describe_missing_states(const KeptStates& kept) {
  if (kept.state_kind == Kind::kNone)
    return "this file keeps no extremal states; indet analyze … --extremal-states canonical stores them";
  return fmt::format(
      "this file keeps the extremal states{} alone; indet analyze … --extremal-states canonical stores all",
      describe_contacts(kept));
}

std::string describe_duals(const Duals& duals) {
  return fmt::format("multipliers and states stored that prove the values of {}",
                     counted(duals.contacts.size(), "contact"));
}

}  // namespace indet::app
