#include "apps/wording.h"

#include <fmt/format.h>

namespace indet::app {

std::string describe_sliding(std::int64_t sliding, std::int64_t non_transmitting) {
  if (non_transmitting <= 0) return counted(sliding, "sliding contact");
  return fmt::format("{}, and {} without force (which count twice: M_s = {})",
                     counted(sliding - 2 * non_transmitting, "sliding contact"), non_transmitting, sliding);
}

std::string describe_method(const ForceRanges& ranges) {
  return ranges.method == Method::kLp ? "linear programs (" + ranges.formulation + ")"
                                      : to_string(ranges.method);
}

}  // namespace indet::app
