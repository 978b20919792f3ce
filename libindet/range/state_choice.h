#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "libindet/range/outcome.h"

namespace indet {

/// Bytes that the extremal states of all contacts may take where nobody asked for them: M contacts have up to
/// 4M states of 2M doubles, so this is passed above 1250 contacts. A choice of memory, not a tolerance.
inline constexpr std::int64_t kStateLimit = 100'000'000;

/// Which extremal states a result keeps, of those that attain its values. What is told of a value (outcome,
/// enclosure, residuals) does not need its state to be kept; d_R, d_T and what is drawn of a state do.
struct StateChoice {
  enum class Kind : std::uint8_t {
    kNone,       ///< none; nor are canonical ones looked for
    kCanonical,  ///< of all that attain a value that of smallest total normal force (canonical_states.h)
    kSolver,     ///< that on which the solver lands
    kUnknown     ///< of results from files that do not tell: one of the two before
  };
  enum class Contacts : std::uint8_t {
    kAll,     ///< all whose ranges are asked for
    kList,    ///< these of `list`
    kLargest  ///< the `largest` of largest δR + δT; of equals those with smaller numbers
  };

  Kind kind = Kind::kCanonical;
  /// kNone in place of the states of all contacts where these can pass kStateLimit.
  bool within_limit = true;
  Contacts contacts = Contacts::kAll;
  std::vector<int> list{};  ///< in any order
  int largest = 0;

  bool keeps_all() const { return kind != Kind::kNone && contacts == Contacts::kAll; }
  /// What contradicts itself or names no contact of `asked_for` (ascending); nothing if all is well.
  std::optional<std::string> defect(const std::vector<int>& asked_for) const;
};

inline constexpr std::array kStateKinds = {StateChoice::Kind::kNone, StateChoice::Kind::kCanonical,
                                           StateChoice::Kind::kSolver, StateChoice::Kind::kUnknown};
inline constexpr std::array kKindsOfStateContacts = {
    StateChoice::Contacts::kAll, StateChoice::Contacts::kList, StateChoice::Contacts::kLargest};
const char* to_string(StateChoice::Kind kind);          ///< "none", "canonical", "solver", "unknown"
const char* to_string(StateChoice::Contacts contacts);  ///< "all", "list", "largest"

/// Bytes that the states of `asked_for` of `contacts` contacts can take.
std::int64_t largest_state_bytes(int asked_for, int contacts);

/// The choice with the limit applied, for a packing of so many contacts, however many of them are asked for:
/// states are what makes a large packing slow.
StateChoice limited(StateChoice choice, int contacts);

/// The contacts of a kList or kLargest, ascending. `value`: their extrema, in the columns of Column, ±inf
/// where unbounded; of a contact with NaN among them no size is known.
std::vector<int> contacts_with_states(const StateChoice& choice, const Table4<double>& value);

/// Which states were kept, as results tell it.
struct KeptStates {
  StateChoice::Kind state_kind = StateChoice::Kind::kUnknown;
  StateChoice::Contacts states_of = StateChoice::Contacts::kAll;
  /// Those contacts, ascending; empty where states_of is kAll.
  Eigen::Array<std::int32_t, Eigen::Dynamic, 1> state_contacts;

  /// True if a value of this contact comes with its state, where it has one.
  bool keeps(int contact) const;
};

}  // namespace indet
