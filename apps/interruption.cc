#include "apps/interruption.h"

#include <fmt/format.h>
#include <semaphore.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <ctime>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>

#include "libindet/io/whole_file.h"

namespace indet::app {
namespace {

using Seconds = std::chrono::duration<double>;

/// For work that hears of a signal to end by itself.
constexpr Seconds kGrace{0.2};
/// Signals within this time are one.
constexpr Seconds kOneSignal{0.05};
/// For a simulation to finish its step, and to write a checkpoint.
constexpr Seconds kCheckpointGrace{10};

std::atomic<int> signal_number = 0;
static_assert(std::atomic<int>::is_always_lock_free);  // for the handler
std::atomic<int> checkpoint_times = 0;
std::atomic<bool> wrote = false;
std::atomic<bool> told = false;
sem_t arrived;

/// What `stopped` says is left, and what is done before the end. It is not destroyed: the watching thread may
/// outlive main().
struct Remains {
  std::mutex mutex;
  std::string text;
  std::function<void()> last_act;
};

Remains& remains() {
  static Remains* const only = new Remains;
  return *only;
}

void remember(int number) {
  signal_number = number == SIGUSR1 ? SIGTERM : number;
  sem_post(&arrived);
}

bool may_write() {
  if (checkpoint_times > 0) return true;
  if (signal_number != 0) return false;
  wrote = true;
  return true;
}

/// Returns whether another signal arrived meanwhile.
bool wait_for_signal(Seconds time) {
  timespec end{};
  clock_gettime(CLOCK_REALTIME, &end);
  const auto nanoseconds =
      end.tv_nsec + std::chrono::nanoseconds(std::chrono::round<std::chrono::nanoseconds>(time)).count();
  end.tv_sec += static_cast<time_t>(nanoseconds / 1'000'000'000);
  end.tv_nsec = static_cast<long>(nanoseconds % 1'000'000'000);
  int result = 0;
  while ((result = sem_timedwait(&arrived, &end)) != 0 && errno == EINTR) {
  }
  return result == 0;
}

void tell(const std::string& text) {
  const std::string line = fmt::format("{}indet: {}\n", isatty(STDERR_FILENO) == 1 ? "\r\x1b[K" : "", text);
  if (write(STDERR_FILENO, line.data(), line.size()) < 0) return;  // there is nobody to tell
}

/// Waits for a signal; if the program has not ended by itself soon after, ends it.
[[noreturn]] void watch() {
  while (sem_wait(&arrived) != 0) {
  }
  // Who signals a process and its group, as timeout does, means one signal.
  std::this_thread::sleep_for(kOneSignal);
  while (sem_trywait(&arrived) == 0) {
  }
  const bool is_urgent = wait_for_signal(kGrace);
  if (!is_urgent && checkpoint_times > 0) {
    tell("stopping; a checkpoint is written at the end of this step (once more Ctrl-C or SIGTERM: none)");
    wait_for_signal(kCheckpointGrace);
  }
  {
    const std::scoped_lock lock(remains().mutex);
    if (remains().last_act) remains().last_act();
  }
  abandon_files();
  _exit(stopped());
}

}  // namespace

void catch_signals() {
  sem_init(&arrived, 0, 0);
  ask_before_writing(&may_write);
  try {
    std::thread(&watch).detach();
  } catch (const std::system_error&) {
    return;  // no thread to be had: signals end the program as they end any other
  }
  std::signal(SIGINT, remember);
  std::signal(SIGTERM, remember);
  std::signal(SIGUSR1, remember);
}

int caught_signal() { return signal_number; }

bool has_written() { return wrote; }
void set_written() { wrote = true; }

int stopped() {
  if (told.exchange(true)) return 128 + signal_number;
  const std::scoped_lock lock(remains().mutex);
  const std::string& text = remains().text;
  tell("interrupted; " + (!text.empty() ? text
                          : wrote       ? "what was written before is whole"
                                        : "nothing was written"));
  return 128 + signal_number;
}

void set_remains(std::string text) {
  const std::scoped_lock lock(remains().mutex);
  remains().text = std::move(text);
}

void set_last_act(std::function<void()> act) {
  const std::scoped_lock lock(remains().mutex);
  remains().last_act = std::move(act);
}

CheckpointTime::CheckpointTime() { ++checkpoint_times; }
CheckpointTime::~CheckpointTime() { --checkpoint_times; }

}  // namespace indet::app
