#pragma once

#include <memory>
#include <span>

#include "libindet/lp/layout.h"
#include "libindet/lp/lp_solver.h"

namespace indet {

/// Maximises linear objectives over one FeasibleSet by GLPK, in one formulation.
///
/// Ladder when a solve fails: the formulation's own simplex from the start vertex, with old factors if there
/// are any, then with new ones; the other simplex from there; from scratch with GLPK's advanced basis;
/// presolved and rescaled; then kFailed. A failed assertion inside GLPK counts as a failed rung; the problem
/// is rebuilt. To be created, used and destroyed on one thread.
class FormulationSolver {
 public:
  /// `set` must outlive the solver.
  FormulationSolver(const SlopeView& view, Formulation formulation, const LpOptions& options);

  /// As Maximiser::maximise; an empty `start` asks for a cold start.
  LpAnswer maximise(const Objective& objective, const Basis& start, std::span<const int> held);

 private:
  enum Rung : int { kGoOn, kWarm, kWarmOther, kCold, kPresolved, kRungs };

  GlpkProblem::Settings settings(Rung rung) const;
  bool stands_at(const Basis& start) const;
  LpStatus attempt(Rung rung, const Objective& objective, const Basis& start, std::span<const int> held,
                   LpAnswer& answer);

  const SlopeView& view_;
  LpOptions options_;
  std::unique_ptr<Layout> layout_;
  std::unique_ptr<GlpkProblem> problem_;
  Basis factorised_;  ///< where GLPK stands, with factors
};

}  // namespace indet
