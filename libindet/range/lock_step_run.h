#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "libindet/barrier/analytic_centre.h"
#include "libindet/barrier/block_structure.h"
#include "libindet/barrier/lock_step.h"

namespace indet {

/// Least values of many objectives, on several threads; barrier::minimise_in_lock_step says how.
struct LockStepRun {
  barrier::LockStepOptions options;
  int threads = 1;
  std::function<barrier::Objective(std::size_t)> objective;
  std::function<void(const barrier::Iterate&)> finish;  ///< on any of the threads
  /// Asked on the calling thread once an iteration; if it says no the run ends with Interrupted.
  std::function<bool()> keep_on;
  std::function<double(std::size_t)> give = {};  ///< where rows are elastic (LockStepCalls)
};

/// Runs the objectives of these numbers. Throws Interrupted, and what `finish` throws.
void run_in_lock_step(const barrier::BlockStructure& structure, const barrier::AnalyticCentre& centre,
                      std::span<const std::size_t> wanted, const LockStepRun& run);

}  // namespace indet
