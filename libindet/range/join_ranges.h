#pragma once

#include <span>

#include "libindet/packing/packing.h"
#include "libindet/range/contact_choice.h"
#include "libindet/range/force_ranges.h"

namespace indet {

/// The ranges of the contacts of a choice, from parts P_1, P_2, … that have those of disjoint sets of
/// contacts whose union it is. Row i of every table is that of the part that has contact i; then
///
///   states, rays  each once, in the order in which `vertex` and `ray` first point to them, row by row
///   counts        Σ over the parts;   largest residuals: of what is joined
///   reactions     those of the one part that has them
///   measures      follow from values and states, as ever (measures.h)
///
/// But for work and times this is to the last bit what one analysis finds.
///
/// Throws InputError where there is no part, a contact is in two parts or in none, or the parts contradict
/// each other: they tell of another polytope, method or kind of states. Preconditions: the choice is kAll or
/// kList; the parts are no estimates.
ForceRanges join_ranges(const Packing& packing, const ContactChoice& choice,
                        std::span<const ForceRanges> parts);

}  // namespace indet
