#pragma once

#include "libindet/exact/contact_problem.h"

namespace indet::exact {

/// Counts exact solves, weighted by size, against a limit: so the same decisions are settled on every
/// machine.
class Work {
 public:
  /// `limit`: in squares of the number of equations, summed over solves, of which each counts 1e3 more.
  Work(const ContactProblem& problem, double limit);

  /// How many pivots a walk may take: those that are left, but no more than end any walk that ends at all.
  int pivots() const;
  /// Counts a walk of so many pivots.
  void add(int pivots) { done_ += (pivots + 1) * solve_; }
  bool is_over() const { return done_ > limit_; }

 private:
  double solve_, limit_;
  double done_ = 0;
};

}  // namespace indet::exact
