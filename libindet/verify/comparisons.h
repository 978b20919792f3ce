#pragma once

#include <fmt/format.h>

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <utility>

#include "libindet/base/tolerances.h"
#include "libindet/verify/verification.h"

namespace indet {

class RebuiltProblem;

/// Compares stored with recomputed numbers and keeps account of it. With `place` messages say which part of
/// the file they are about.
class Comparisons {
 public:
  explicit Comparisons(std::string place = {}) : place_(std::move(place)) {}

  /// Counts one comparison. The text is made only if it failed.
  template <class... Parts>
  bool require(bool holds, fmt::format_string<Parts...> text, Parts&&... parts) {
    ++result_.checks;
    if (!holds) contradict(fmt::format(text, std::forward<Parts>(parts)...));
    return holds;
  }

  /// Two NaN and two equal infinities agree; else the difference is at most tolerance · max(scale,
  /// |expected|).
  bool equal(double stored, double expected, const std::string& name,
             double tolerance = tolerance::kAgreement, double scale = 1);
  /// For p-values. A tail e^−x carries the rounding of x times x, so that the tolerance
  /// tolerance::kProbabilityAgreement is relative to p max(1, −ln p); numbers below the smallest normal one
  /// have lost their digits, and agree.
  bool equal_probability(double stored, double expected, const std::string& name);
  bool equal_count(std::int64_t stored, std::int64_t expected, const std::string& name);

  /// Puts a contact state (mg) into the account of states. Returns the larger of its imbalance and its
  /// violation of the contact conditions.
  double add_state(const RebuiltProblem& problem, const Eigen::VectorXd& forces);
  /// Puts a value whose optimality was examined into the account.
  void add_optimum(double gap);

  void leave_unchecked(std::string what) { result_.unchecked.push_back(std::move(what)); }
  void remark(std::string what) { result_.remarks.push_back(std::move(what)); }
  void call_unsolved(std::string what) { result_.unsolved.push_back(std::move(what)); }

  const Verification& result() const { return result_; }

 private:
  void contradict(std::string message);

  std::string place_;
  Verification result_;
};

}  // namespace indet
