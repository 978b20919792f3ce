#pragma once

#include <map>
#include <optional>
#include <string>

#include "libindet/io/density_rule.h"
#include "libindet/io/fixed_rule.h"
#include "libindet/io/friction_rule.h"
#include "libindet/io/plane.h"
#include "libindet/packing/packing.h"

namespace indet {

/// What the files of another code do not say, or say otherwise than the user wants.
struct ImportSettings {
  FrictionRule friction{};           ///< Needed unless the files have it.
  FixedRule fixed{};                 ///< Beside those that the files call fixed.
  DensityRule density{};             ///< Needed, and taken, where files have no masses.
  std::optional<Vector2> gravity{};  ///< In the axes of `plane`; none: that of the files, else
                                     ///< (0, −1), or (0, 0) in a full cell.
  double force_unit = 0;             ///< Unit of force of printed numbers; 0: the mean weight.
  Plane plane{};
  /// Names of columns that differ from the defaults, where a format has columns.
  std::map<std::string, std::string> columns{};
};

}  // namespace indet
