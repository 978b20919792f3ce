#include "libindet/range/contact_choice.h"

#include <algorithm>
#include <numeric>

#include "libindet/base/random.h"

namespace indet {

const char* to_string(ContactChoice::Kind kind) {
  switch (kind) {
    case ContactChoice::Kind::kAll:
      return "all";
    case ContactChoice::Kind::kSample:
      return "sample";
    case ContactChoice::Kind::kList:
      return "list";
  }
  return "?";
}

std::vector<int> chosen_contacts(const ContactChoice& choice, int contacts) {
  std::vector<int> chosen = choice.list;
  if (choice.kind != ContactChoice::Kind::kList) {
    chosen.resize(static_cast<std::size_t>(contacts));
    std::iota(chosen.begin(), chosen.end(), 0);
  }
  if (choice.kind == ContactChoice::Kind::kSample) {
    const auto size = static_cast<std::size_t>(std::min(choice.sample_size, contacts));
    Random random(choice.seed);
    for (std::size_t i = 0; i < size; ++i) std::swap(chosen[i], chosen[i + random.below(chosen.size() - i)]);
    chosen.resize(size);
  }
  std::sort(chosen.begin(), chosen.end());
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  return chosen;
}

}  // namespace indet
