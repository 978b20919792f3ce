#include "libindet/range/state_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace indet {

std::optional<std::string> StateChoice::defect(const std::vector<int>& asked_for) const {
  if (kind == Kind::kUnknown) return "which extremal states to keep is not said";
  if (contacts == Contacts::kAll) return {};
  if (kind == Kind::kNone) return "the states of some contacts are asked for, but none are to be kept";
  if (contacts == Contacts::kLargest && largest < 1)
    return fmt::format("the states of {} contacts are asked for; it must be at least 1", largest);
  if (contacts == Contacts::kList && list.empty()) return "the states of no contact are asked for";
  if (contacts != Contacts::kList) return {};
  for (const int contact : list) {
    if (!std::binary_search(asked_for.begin(), asked_for.end(), contact))
      return fmt::format("the states of contact {} are asked for, but its ranges are not", contact);
  }
  return {};
}

const char* to_string(StateChoice::Kind kind) {
  switch (kind) {
    case StateChoice::Kind::kNone:
      return "none";
    case StateChoice::Kind::kCanonical:
      return "canonical";
    case StateChoice::Kind::kSolver:
      return "solver";
    case StateChoice::Kind::kUnknown:
      return "unknown";
  }
  return "?";
}

const char* to_string(StateChoice::Contacts contacts) {
  switch (contacts) {
    case StateChoice::Contacts::kAll:
      return "all";
    case StateChoice::Contacts::kList:
      return "list";
    case StateChoice::Contacts::kLargest:
      return "largest";
  }
  return "?";
}

std::int64_t largest_state_bytes(int asked_for, int contacts) {
  return std::int64_t{4} * asked_for * 2 * contacts * static_cast<std::int64_t>(sizeof(double));
}

StateChoice limited(StateChoice choice, int contacts) {
  const bool is_limited = choice.within_limit && choice.keeps_all();
  if (is_limited && largest_state_bytes(contacts, contacts) > kStateLimit)
    choice.kind = StateChoice::Kind::kNone;
  return choice;
}

std::vector<int> contacts_with_states(const StateChoice& choice, const Table4<double>& value) {
  std::vector<int> chosen = choice.list;
  if (choice.contacts == StateChoice::Contacts::kLargest) {
    const Eigen::ArrayXd size =
        value.col(kMaxR) - value.col(kMinR) + value.col(kMaxT) - value.col(kMinT);  // δR + δT
    chosen.clear();
    for (Eigen::Index i = 0; i < size.size(); ++i) {
      if (!std::isnan(size[i])) chosen.push_back(static_cast<int>(i));
    }
    std::stable_sort(chosen.begin(), chosen.end(), [&](int a, int b) { return size[a] > size[b]; });
    chosen.resize(std::min(chosen.size(), static_cast<std::size_t>(choice.largest)));
  }
  std::sort(chosen.begin(), chosen.end());
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  return chosen;
}

bool KeptStates::keeps(int contact) const {
  if (state_kind == StateChoice::Kind::kNone) return false;
  return states_of == StateChoice::Contacts::kAll ||
         std::binary_search(state_contacts.begin(), state_contacts.end(), contact);
}

}  // namespace indet
