#include "libindet/range/duals.h"

#include "libindet/range/contact_choice.h"

namespace indet {

std::vector<int> contacts_with_duals(const DualChoice& choice, const std::vector<int>& asked_for) {
  switch (choice.kind) {
    case DualChoice::Kind::kNone:
      return {};
    case DualChoice::Kind::kSample:
      return draw_without_replacement(asked_for, choice.sample_size, choice.seed);
    case DualChoice::Kind::kAll:
      return asked_for;
  }
  return {};
}

}  // namespace indet
