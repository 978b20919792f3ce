#include "libindet/verify/exact_tally.h"

#include <algorithm>
#include <utility>

namespace indet {

void ExactTally::count(Proof proof) {
  proven += proof == Proof::kProven ? 1 : 0;
  repaired += proof == Proof::kRepaired ? 1 : 0;
  refuted += proof == Proof::kRefuted ? 1 : 0;
  undecided += proof == Proof::kUndecided ? 1 : 0;
}

void ExactTally::add_message(std::string text) {
  constexpr std::size_t kShown = 20;
  if (messages.size() < kShown) messages.push_back(std::move(text));
}

void ExactTally::add(const ExactTally& other) {
  proven += other.proven;
  repaired += other.repaired;
  refuted += other.refuted;
  undecided += other.undecided;
  pivots += other.pivots;
  rational += other.rational;
  contradictions += other.contradictions;
  worst_error = std::max(worst_error, other.worst_error);
  worst_certified_error = std::max(worst_certified_error, other.worst_certified_error);
  for (const std::string& text : other.messages) add_message(text);
}

}  // namespace indet
