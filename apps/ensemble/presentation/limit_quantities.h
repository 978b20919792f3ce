#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "apps/ensemble/presentation/curves.h"
#include "apps/ensemble/tables/ensemble_tables.h"
#include "libindet/statistics/bootstrap.h"

namespace indet {

/// What it means that a number is large.
enum class LargeMeans : std::uint8_t { kStable, kUnstable, kNeither };

/// A number of each packing that follows from its limits; infinite where it has no limit, NaN where that is
/// not known.
struct LimitQuantity {
  const char* name;
  int digits;  ///< after the point
  LargeMeans large;
  double (*of)(const FlatTable& runs, std::size_t run);
};

/// The smaller of the two angles, in degrees, at which gravity moves some disk, or several disks.
extern const LimitQuantity kTiltOfAny, kTiltOfSeveral;
/// The largest load on the highest disk, in mg; the least factor of the coefficients of friction.
extern const LimitQuantity kLoadOnTop, kLeastFriction;
/// Of the states at the smaller tilt of several disks: sliding contacts M_s, the dimension that is left of F,
/// and that as a fraction of 2M − 3N.
extern const LimitQuantity kSlidingThere, kDimensionThere, kDimensionsLeft;

/// All of them, in the order of the table.
std::vector<LimitQuantity> limit_quantities();

/// Of the packings of a protocol.
std::vector<double> values_of(const EnsembleTables& tables, sim::Protocol protocol,
                              const LimitQuantity& quantity);

/// CD − MD: the mean over seeds of the difference of their means. Its standard error does without that of the
/// scene, which packings of one seed share.
Estimate difference_of_methods(const EnsembleTables& tables, const LimitQuantity& quantity);

/// "CD" or "MD" where the difference is above two of its standard errors, else "not decided"; "" if it tells
/// nothing of stability.
std::string more_stable(const Estimate& difference, const LimitQuantity& quantity);

/// Families whose packings have some limit.
std::vector<Family> families_with_limits(const EnsembleTables& tables);

}  // namespace indet
