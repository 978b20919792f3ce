#include "libindet/range/lock_step_team.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <optional>
#include <thread>
#include <vector>

#include "libindet/base/error.h"

namespace indet {

void minimise_on_threads(const barrier::BlockStructure& structure, const barrier::AnalyticCentre& centre,
                         const barrier::LockStepOptions& options, std::span<const std::size_t> numbers,
                         int threads, barrier::LockStepCalls calls) {
  if (numbers.empty()) return;
  std::atomic<std::size_t> next = 0;
  std::atomic<bool> stopped = false;
  std::exception_ptr failure;
  calls.next = [&]() -> std::optional<std::size_t> {
    const std::size_t k = next++;
    return k < numbers.size() ? std::optional(numbers[k]) : std::nullopt;
  };
  const auto run = [&](bool is_calling_thread) {
    barrier::LockStepCalls own = calls;
    own.keep_on = [&, is_calling_thread] {
      if (is_calling_thread && !calls.keep_on()) stopped = true;
      return !stopped;
    };
    try {
      barrier::minimise_in_lock_step(structure, centre, options, own);
    } catch (...) {
      if (!stopped.exchange(true)) failure = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> others;
    const std::size_t useful =
        std::min(static_cast<std::size_t>(std::max(1, threads)), (numbers.size() + 7) / 8);
    for (std::size_t k = 1; k < useful; ++k) others.emplace_back(run, false);
    run(true);
  }
  if (failure) std::rethrow_exception(failure);
  if (stopped) throw Interrupted();
}

}  // namespace indet
