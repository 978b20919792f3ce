#include "libindet/barrier/ordering.h"

#include <amd.h>

#include <algorithm>
#include <string>

#include "libindet/base/error.h"

namespace indet::barrier {

std::vector<int> fill_reducing_order(const std::vector<std::vector<int>>& neighbours,
                                     const std::vector<bool>& last) {
  const auto count = neighbours.size();
  std::vector<int> number(count, -1);
  std::vector<int> kept;
  for (std::size_t i = 0; i < count; ++i) {
    if (last[i]) continue;
    number[i] = static_cast<int>(kept.size());
    kept.push_back(static_cast<int>(i));
  }
  std::vector<int> start{0};
  std::vector<int> entries;
  for (const int i : kept) {
    for (const int j : neighbours[static_cast<std::size_t>(i)]) {
      if (number[static_cast<std::size_t>(j)] >= 0) entries.push_back(number[static_cast<std::size_t>(j)]);
    }
    start.push_back(static_cast<int>(entries.size()));
  }
  std::vector<int> order(kept.size());
  if (!kept.empty()) {
    entries.resize(std::max<std::size_t>(1, entries.size()));
    const int status = amd_order(static_cast<int>(kept.size()), start.data(), entries.data(), order.data(),
                                 nullptr, nullptr);
    if (status != AMD_OK && status != AMD_OK_BUT_JUMBLED)
      throw LibraryError("the equations of equilibrium could not be ordered (AMD status " +
                         std::to_string(status) + ")");
  }
  for (int& i : order) i = kept[static_cast<std::size_t>(i)];
  for (std::size_t i = 0; i < count; ++i) {
    if (last[i]) order.push_back(static_cast<int>(i));
  }
  return order;
}

}  // namespace indet::barrier
