#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "libindet/range/force_ranges.h"

namespace indet::test {

/// True where a and b are the same infinity, both NaN, or differ by at most tolerance · max(1, |a|).
bool near(double a, double b, double tolerance);

/// The same entries, sizes included, in the sense of near(). Names the first that differs.
testing::AssertionResult same_entries(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double tolerance);

// The following go through the list of fields (libindet/range/result_fields.h), so that none is forgotten.

/// Every field but the timings has the same bytes.
testing::AssertionResult same_bytes(const ForceRanges& a, const ForceRanges& b);

/// All fields agree that follow from the problem, the polytope, or the states that attain the values
/// (FieldSource), within `tolerance` relative to max(1, |value|), forces in mg. (Numbers of states may
/// differ.)
testing::AssertionResult same_ranges(const ForceRanges& a, const ForceRanges& b, double tolerance);

/// Of these the fields of extremal states alone: each value is attained by the same state, and what is
/// measured on them is the same.
testing::AssertionResult same_extremal_states(const ForceRanges& a, const ForceRanges& b, double tolerance);

/// The same, but of the extremal states only the total normal force: what must agree where several states of
/// smallest total normal force attain an optimum, and the choice between them is arbitrary.
testing::AssertionResult same_ranges_and_weights(const ForceRanges& a, const ForceRanges& b,
                                                 double tolerance);

/// How a ForceRanges would read with the contacts in another order (contact k of the result is contacts[k]),
/// in another unit of force, or with all tangential forces reversed. Half-planes (`active`), motions and
/// estimates from samples stay as they are.
ForceRanges permuted(const ForceRanges& ranges, const std::vector<int>& contacts);
ForceRanges rescaled(const ForceRanges& ranges, double force);
ForceRanges mirrored(const ForceRanges& ranges);

/// The motion proves that the packing cannot stand: the load does positive work, and no edge of any contact's
/// cone does negative work (R n̂ ± μ R t̂ times the relative velocity is ≥ 0: the contact opens or slips with
/// the force, or rests).
testing::AssertionResult is_falling_motion(const Packing& packing, const Eigen::MatrixXd& motion,
                                           double tolerance);

/// The direction lies in ker c ∩ K and is not zero.
testing::AssertionResult is_recession_ray(const Packing& packing, const Eigen::VectorXd& ray,
                                          double tolerance);

/// Each infinite end of a range, and no other, has a ray of ker c ∩ K along which the force grows that way.
testing::AssertionResult has_rays_where_infinite(const Packing& packing, const ForceRanges& ranges,
                                                 double tolerance);

}  // namespace indet::test
