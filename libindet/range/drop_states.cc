#include "libindet/range/drop_states.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "libindet/base/constants.h"

namespace indet {

ForceRanges drop_states(ForceRanges ranges, const StateChoice& kept) {
  if (kept.keeps_all()) return ranges;
  ranges.states_of = kept.contacts;
  if (kept.kind == StateChoice::Kind::kNone) {
    ranges.state_kind = kept.kind;
    ranges.state_contacts.resize(0);
  } else {
    const std::vector<int> chosen = contacts_with_states(kept, ranges.value);
    ranges.state_contacts = Eigen::Map<const Eigen::ArrayXi>(chosen.data(), std::ssize(chosen));
  }
  std::vector<Eigen::Index> rows;  // that stay
  std::vector<std::int32_t> number(static_cast<std::size_t>(ranges.states.rows()), -1);
  for (Eigen::Index i = 0; i < ranges.vertex.rows(); ++i) {
    for (std::int32_t& vertex : ranges.vertex.row(i)) {
      if (vertex < 0) continue;
      if (!ranges.keeps(static_cast<int>(i))) {
        vertex = -1;
        continue;
      }
      std::int32_t& at = number[static_cast<std::size_t>(vertex)];
      if (at < 0) {
        at = static_cast<std::int32_t>(rows.size());
        rows.push_back(vertex);
      }
      vertex = at;
    }
  }
  ranges.states = Rows<double>(ranges.states(rows, Eigen::all));
  ranges.active = decltype(ranges.active)(ranges.active(rows, Eigen::all));
  measure_states(ranges, ranges.force_unit, ranges);
  ranges.solver_states.reset();
  return ranges;
}

}  // namespace indet
