#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "libindet/barrier/lock_step.h"
#include "libindet/polytope/central_polytope.h"

namespace indet {

/// Minimises those of the objectives whose numbers are `wanted` by the barrier method, on several threads,
/// the calling one among them. `finish` is called from any of them. `keep_on` is asked now and then on the
/// calling thread; false stops all (Interrupted). What an objective leads to depends neither on the threads
/// nor on the others.
void minimise_on_threads(const CentralPolytope& central, const barrier::LockStepOptions& lock_step,
                         int threads, std::span<const barrier::Objective> objectives,
                         const std::vector<std::size_t>& wanted,
                         const std::function<void(const barrier::Iterate&)>& finish,
                         const std::function<bool()>& keep_on);

}  // namespace indet
