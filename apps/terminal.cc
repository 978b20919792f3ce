#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <string>
#include <thread>

#include "apps/command.h"
#include "apps/interruption.h"
#include "apps/scheduler.h"
#include "libindet/base/printable.h"
#include "libindet/base/remaining_time.h"

namespace indet::app {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// One bar at a time, redrawn at most ten times a second and removed when its stage ends.
class ProgressBar {
 public:
  explicit ProgressBar(bool visible) : visible_(visible) {}
  ~ProgressBar() { clear(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void update(const Progress& progress) {
    if (!visible_) return;
    if (progress.stage != stage_) {
      clear();
      stage_ = progress.stage;
      start_ = drawn_ = Clock::now();
      remaining_ = {};
      return;
    }
    if (seconds_since(start_) < 0.5 || seconds_since(drawn_) < 0.1) return;
    drawn_ = Clock::now();
    remaining_.update(seconds_since(start_), share_of(progress));
    std::cerr << "\r\x1b[K" << line(progress) << std::flush;
    shown_ = true;
  }

 private:
  static double share_of(const Progress& progress) {
    if (progress.total <= 0) return 0;
    return std::clamp(static_cast<double>(progress.done) / static_cast<double>(progress.total), 0.0, 1.0);
  }

  std::string line(const Progress& progress) const {
    std::string text = stage_;
    if (progress.total > 0) {
      const double fraction = share_of(progress);
      constexpr int kWidth = 24;
      const int filled = static_cast<int>(fraction * kWidth);
      text += fmt::format(" [{}{}] {:3.0f} %", std::string(static_cast<std::size_t>(filled), '#'),
                          std::string(static_cast<std::size_t>(kWidth - filled), '.'), 100 * fraction);
      if (const auto left = remaining_.seconds(); left && fraction > 0.02)
        text += fmt::format(", {:.0f} s left", *left);
    } else {
      text += fmt::format(" {}, {:.0f} s", progress.done, seconds_since(start_));
    }
    if (!progress.details.empty()) text += fmt::format("  {}", progress.details);
    return text;
  }

  void clear() {
    if (shown_) std::cerr << "\r\x1b[K" << std::flush;
    shown_ = false;
  }

  bool visible_;
  bool shown_ = false;
  std::string stage_;
  RemainingTime remaining_;
  Clock::time_point start_;
  Clock::time_point drawn_;
};

}  // namespace

int Context::thread_count() const {
  if (threads > 0) return threads;
  return processors_of_task().value_or(static_cast<int>(std::max(1U, std::thread::hardware_concurrency())));
}

ProgressCallback Context::progress() const {
  const bool visible = !quiet && isatty(STDERR_FILENO) == 1;
  return [bar = std::make_shared<ProgressBar>(visible)](const Progress& progress) {
    bar->update(progress);
    return caught_signal() == 0;
  };
}

void Context::note(const std::string& text) const {
  if (!quiet) std::cerr << printable(text) << '\n';
}

void Context::warn(const std::string& text) const {
  const bool colour = isatty(STDERR_FILENO) == 1 && std::getenv("NO_COLOR") == nullptr;
  std::cerr << (colour ? "\x1b[33mwarning:\x1b[0m " : "warning: ") << printable(text) << '\n';
}

}  // namespace indet::app
