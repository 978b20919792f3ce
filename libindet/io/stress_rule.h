#pragma once

#include <optional>
#include <string>
#include <vector>

#include "libindet/io/imported_packing.h"

namespace indet {

/// Which stress an import imposes on the cell of a packing that is periodic in both directions: what the user
/// says; else what the files say; else that which the known forces make.
struct StressRule {
  bool is_given = false;
  Stress stress;  ///< Without a component: none is imposed.

  /// "none", or xx=, yy=, xy=, pressure= with numbers. Throws InputError with the reason.
  static StressRule parse(const std::vector<std::string>& items);
};

/// What is known of the stress of an imported packing.
struct StressReport {
  std::optional<Eigen::Matrix2d> of_forces;  ///< If all forces are known and the cell is full.
  bool is_taken_from_forces = false;         ///< That which is imposed.
};

/// Imposes the stress on the packing. Throws InputError if the rule gives one where none can be imposed, or
/// beside one that the files name; `option` is the name of the rule in the message.
StressReport impose_stress(ImportedPacking& imported, const StressRule& rule, const std::string& option);

}  // namespace indet
