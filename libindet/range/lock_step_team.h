#pragma once

#include <cstddef>
#include <span>

#include "libindet/barrier/lock_step.h"

namespace indet {

/// barrier::minimise_in_lock_step of the objectives of these numbers, on so many threads, the calling one
/// among them. Of `calls`, `next` is not used, and `keep_on` is asked on the calling thread alone; where it
/// says no, Interrupted is thrown. The others may be called on any thread.
void minimise_on_threads(const barrier::BlockStructure& structure, const barrier::AnalyticCentre& centre,
                         const barrier::LockStepOptions& options, std::span<const std::size_t> numbers,
                         int threads, barrier::LockStepCalls calls);

}  // namespace indet
