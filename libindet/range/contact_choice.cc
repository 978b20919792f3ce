#include "libindet/range/contact_choice.h"

#include <algorithm>
#include <numeric>
#include <utility>

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
    case ContactChoice::Kind::kCalibration:
      return "calibration";
  }
  return "?";
}

std::vector<int> draw_without_replacement(std::vector<int> from, int size, std::uint64_t seed) {
  const std::size_t count = std::min(static_cast<std::size_t>(size), from.size());
  Random random(seed);
  for (std::size_t i = 0; i < count; ++i) std::swap(from[i], from[i + random.below(from.size() - i)]);
  from.resize(count);
  std::sort(from.begin(), from.end());
  return from;
}

std::vector<int> chosen_contacts(const ContactChoice& choice, int contacts) {
  std::vector<int> chosen = choice.list;
  if (choice.kind != ContactChoice::Kind::kList) {
    chosen.resize(static_cast<std::size_t>(contacts));
    std::iota(chosen.begin(), chosen.end(), 0);
  }
  if (choice.kind == ContactChoice::Kind::kSample)
    chosen = draw_without_replacement(std::move(chosen), choice.sample_size, choice.seed);
  std::sort(chosen.begin(), chosen.end());
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  return chosen;
}

}  // namespace indet
