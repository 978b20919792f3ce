#include "libindet/range/lock_step_run.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <optional>
#include <thread>
#include <vector>

#include "libindet/base/error.h"

namespace indet {

void run_in_lock_step(const barrier::BlockStructure& structure, const barrier::AnalyticCentre& centre,
                      std::span<const std::size_t> wanted, const LockStepRun& run) {
  if (wanted.empty()) return;
  std::atomic<std::size_t> next = 0;
  std::atomic<bool> stopped = false;
  std::exception_ptr failure;
  const auto go = [&](bool is_calling_thread) {
    try {
      barrier::minimise_in_lock_step(structure, centre, run.options,
                                     {.next = [&]() -> std::optional<std::size_t> {
                                        const std::size_t k = next++;
                                        return k < wanted.size() ? std::optional(wanted[k]) : std::nullopt;
                                      },
                                      .objective = run.objective,
                                      .finish = run.finish,
                                      .keep_on =
                                          [&] {
                                            if (is_calling_thread && run.keep_on && !run.keep_on())
                                              stopped = true;
                                            return !stopped;
                                          },
                                      .give = run.give});
    } catch (...) {
      if (!stopped.exchange(true)) failure = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> others;
    const auto most = static_cast<std::size_t>(std::max(1, run.threads));
    const std::size_t useful = std::min(most, (wanted.size() + 7) / 8);
    for (std::size_t k = 1; k < useful; ++k) others.emplace_back(go, false);
    go(true);
  }
  if (failure) std::rethrow_exception(failure);
  if (stopped) throw Interrupted();
}

}  // namespace indet
