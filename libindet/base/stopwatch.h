#pragma once

#include <chrono>
#include <map>
#include <string>

namespace indet {

/// Seconds since it was made.
class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point begin_ = Clock::now();
};

/// Adds the time since the last mark to a stage.
class StageTimes {
 public:
  explicit StageTimes(std::map<std::string, double>& seconds) : seconds_(seconds) {}
  void mark(const std::string& stage) {
    seconds_[stage] += since_last_.seconds();
    since_last_ = {};
  }

 private:
  std::map<std::string, double>& seconds_;
  Stopwatch since_last_;
};

}  // namespace indet
