#pragma once

#include <optional>

#include "libindet/packing/packing.h"
#include "libindet/range/force_ranges.h"
#include "libindet/verify/comparisons.h"
#include "libindet/verify/exact_check.h"

namespace indet {

/// The answers of rational arithmetic to ranges that it found (ForceRanges::exact), searched for when first
/// asked for: where the rank or the optimum lies within rounding, double precision sees another one.
class ExactAnswers {
 public:
  /// Both must outlive this.
  ExactAnswers(const Packing& packing, const ForceRanges& ranges) : packing_(packing), ranges_(ranges) {}

  /// Whether the stored bounds are those of the exact value; false of ranges that are not exact.
  bool agree_on_value(int contact, int column) const;
  bool agree_on_reaction(Eigen::Index row, int end) const;

  /// Whether no state is admissible.
  bool agree_on_emptiness() const { return ranges_.exact && check().proves_emptiness; }

  /// Checks status, dim and blocks. Precondition: the ranges are exact, and F is not empty.
  void check_structure(Comparisons& compare) const;

 private:
  const ExactCheck& check() const;
  const Packing& packing_;
  const ForceRanges& ranges_;
  mutable std::optional<ExactCheck> check_;
};

}  // namespace indet
