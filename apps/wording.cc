#include "apps/wording.h"

#include <fmt/format.h>

namespace indet::app {

std::string describe_sliding(std::int64_t sliding, std::int64_t non_transmitting) {
  if (non_transmitting <= 0) return counted(sliding, "sliding contact");
  return fmt::format("{}, and {} without force (which count twice: M_s = {})",
                     counted(sliding - 2 * non_transmitting, "sliding contact"), non_transmitting, sliding);
}

std::string describe_method(const ForceRanges& ranges) {
  switch (ranges.method) {
    case Method::kLp:
      return "linear programs (" + ranges.formulation + ")";
    case Method::kPivotingPaper:
      return fmt::format("{} (neighbour: {}, start: {})", to_string(ranges.method),
                         to_string(ranges.paper_options.neighbour), to_string(ranges.paper_options.start));
    case Method::kPivotingTableau:
      break;
  }
  return to_string(ranges.method);
}

}  // namespace indet::app
