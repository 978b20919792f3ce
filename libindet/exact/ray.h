#pragma once

#include <memory>
#include <span>
#include <vector>

#include "libindet/exact/contact_problem.h"

namespace indet::exact {

/// The rays that load some edges and no others: x > 0 on these with A x = 0, directions in ker c ∩ K.
///
/// Some of the edges are free, and the others follow from A x = 0. What rounding leaves of it in a guess,
/// times the condition of those others, may exceed their strengths (in regular arrays the condition is
/// large): so a guess is first moved by the least, in the sense of squares, that makes A x far smaller than
/// rounding. Then the exact ray with these free strengths is near.
class RaysOnEdges {
 public:
  /// `problem` must outlive this. `preference`: one number an edge of the problem; the greater, the sooner it
  /// follows from others.
  RaysOnEdges(const ContactProblem& problem, std::vector<int> edges, std::span<const double> preference);
  ~RaysOnEdges();

  /// Whether one is proven to be near the guess (one an edge of the problem), within tolerance::kRayEntry: it
  /// then grows each component whose sign is clear in the guess.
  bool contain_one_near(std::span<const double> guess) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The edges of the problem whose strength is above `zero`.
std::vector<int> loaded_edges(const ContactProblem& problem, std::span<const double> guess, double zero);

/// Whether a ray near the guess that loads the edges above `zero` alone is proven.
bool proves_ray(const ContactProblem& problem, std::span<const double> guess, double zero);

}  // namespace indet::exact
