#include "libindet/verify/sensitivity_check.h"

#include <cmath>

namespace indet {
namespace {

bool is_possible(double sensitivity, SensitivityClaim claim) {
  switch (claim) {
    case SensitivityClaim::kNone:
      return std::isnan(sensitivity) || (sensitivity >= 0 && std::isfinite(sensitivity));
    case SensitivityClaim::kBound:
      return sensitivity >= 0;
    case SensitivityClaim::kExact:
      return sensitivity >= 0 && std::isfinite(sensitivity);
  }
  return false;
}

}  // namespace

void check_sensitivity(const ForceRanges& ranges, int contact, int column, const std::string& place,
                       Comparisons& compare) {
  const double sensitivity = ranges.sensitivity.value(contact, column);
  const int claim = ranges.sensitivity.claim(contact, column);
  compare.require(is_possible(sensitivity, static_cast<SensitivityClaim>(claim)),
                  "{}: the sensitivity {} and its claim {} do not go together", place, sensitivity, claim);
}

}  // namespace indet
