#pragma once

#include "libindet/io/imported_packing.h"
#include "libindet/io/levers.h"

namespace indet {

/// Chooses levers, sets those of all contacts that have none of their own, and keeps the choice in
/// `imported.levers`. With τ_i the net torque on disk i,
///
///   τ_i = torque of its load + Σ T l,   l = r (radius) or r − δ/2 (mid-overlap), δ = −gap,
///
/// each choice that `rule` allows leaves the residual max |τ_i|/r_i over the free disks. Of the choices that
/// leave at most `tolerance` (mg) the one with the smallest residual is taken; but `documented`, the one that
/// the format documents, where its residual is at most ten times as large or below 1e-12 mg. If none
/// balances, or some forces are not known, `documented` is taken as far as `rule` allows. A packing of which
/// a contact has levers of its own is left as it is, without a choice.
void choose_levers(ImportedPacking& imported, const LeverRule& rule, const Levers& documented,
                   double tolerance);

}  // namespace indet
