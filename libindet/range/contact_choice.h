#pragma once

#include <cstdint>
#include <vector>

#include "libindet/range/contact_draw.h"

namespace indet {

/// The contacts whose ranges are wanted. kCalibration: those that estimates of all others rest on
/// (estimates.h), which no one chooses in this way.
struct ContactChoice {
  enum class Kind : std::uint8_t { kAll, kSample, kList, kCalibration };
  Kind kind = Kind::kAll;
  /// kSample: how many draws. They are those of contact_draw.h where the analytic centre is there, and of
  /// equally likely contacts without replacement elsewhere.
  int sample_size = 0;
  std::uint64_t seed = 1;   ///< kSample
  std::vector<int> list{};  ///< kList: indices of contacts, in any order
};

/// "all", "sample", "list", "calibration".
const char* to_string(ContactChoice::Kind kind);

/// The chosen among `contacts` contacts, ascending, each once. A sample larger than that is all of them. The
/// same seed gives the same sample on any machine. Preconditions: 0 ≤ list entries < contacts; no
/// kCalibration.
std::vector<int> chosen_contacts(const ContactChoice& choice, int contacts);

/// `size` of these, or all where there are fewer, drawn without replacement, each set of that size equally
/// likely; ascending. The same seed gives the same draw on any machine.
std::vector<int> draw_without_replacement(std::vector<int> from, int size, std::uint64_t seed);

/// Which contacts were asked for, as results tell it, and how they were drawn.
struct ContactRequest : ContactDraw {
  ContactChoice::Kind choice = ContactChoice::Kind::kAll;
  int requested = -1;             ///< How many contacts, each counted once.
  std::int64_t sample_seed = -1;  ///< Of a sample or a calibration; −1: of none.
};

}  // namespace indet
