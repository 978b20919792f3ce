#pragma once

#include <string>

#include "libindet/io/sampling_file.h"
#include "libindet/packing/packing.h"
#include "libindet/range/force_ranges.h"
#include "libindet/verify/verification.h"

namespace indet {

/// Checks what `indet sample` stored, against the packing and against itself, with code of its own:
///
///   - the centre and each stored state: equilibrium and contact conditions (a mean of states is a state);
///   - what follows from these and the packing: distance and sliding contacts of the simulated state,
///   residual,
///     dim F and its independent parts (from the half-planes without slack at the centre);
///   - what follows from other stored numbers: r² = Σ σ_k², ⟨‖F‖²⟩ = ‖F°‖² + r², the account of sweeps, the
///     extremes of R̂ and effective sizes, convergence, covariances;
///   - bounds that hold for every sample: of a quantile by mean and σ (Cantelli), of σ and r by the ranges
///     (Bhatia and Davis: σ² ≤ (max − mean)(mean − min)), of volume and widths by ball and diameter;
///   - where the file holds all samples (`--states`), every number of theirs: mean, σ, quantiles,
///   covariances,
///     r, spread, R̂, effective sizes, percentiles.
///
/// What is left is named in `unchecked`. `place`: the group that the record is from, for messages. `ranges`:
/// of the same file, or null. A sample that has not converged, and widths that were not solved, are
/// `unsolved`.
Verification verify_samples(const Packing& packing, const SamplingRecord& record, const std::string& place,
                            const ForceRanges* ranges);

}  // namespace indet
