#include "libindet/range/threaded_search.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <optional>
#include <thread>

#include "libindet/base/error.h"

namespace indet {

void minimise_on_threads(const CentralPolytope& central, const barrier::LockStepOptions& lock_step,
                         int threads, std::span<const barrier::Objective> objectives,
                         const std::vector<std::size_t>& wanted,
                         const std::function<void(const barrier::Iterate&)>& finish,
                         const std::function<bool()>& keep_on) {
  if (wanted.empty()) return;
  std::atomic<std::size_t> next = 0;
  std::atomic<bool> stopped = false;
  std::exception_ptr failure;
  const auto run = [&](bool is_calling_thread) {
    try {
      barrier::minimise_in_lock_step(
          central.structure, central.centre, lock_step,
          {.next = [&]() -> std::optional<std::size_t> {
             const std::size_t k = next++;
             return k < wanted.size() ? std::optional(wanted[k]) : std::nullopt;
           },
           .objective = [&](std::size_t k) -> const barrier::Objective& { return objectives[k]; },
           .finish = finish,
           .keep_on =
               [&] {
                 if (is_calling_thread && !keep_on()) stopped = true;
                 return !stopped;
               }});
    } catch (...) {
      if (!stopped.exchange(true)) failure = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> others;
    const auto lanes = static_cast<std::size_t>(std::max(1, threads));
    const std::size_t useful = std::min(lanes, (wanted.size() + 7) / 8);
    for (std::size_t k = 1; k < useful; ++k) others.emplace_back(run, false);
    run(true);
  }
  if (failure) std::rethrow_exception(failure);
  if (stopped) throw Interrupted();
}

}  // namespace indet
