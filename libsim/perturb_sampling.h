#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "libindet/base/progress.h"
#include "libindet/base/tolerances.h"
#include "libindet/packing/packing.h"
#include "libsim/polish.h"
#include "libsim/static_solver.h"

namespace indet::sim {

/// Perturb-and-resolve, the ensemble of equation [38] of the paper: the contact forces of a packing are
/// multiplied by random numbers uniform in [1 − width, 1 + width], one for each contact, and given to the
/// iterative solver as its start; the solution that it finds is one sample of the polytope. With samples F_i
/// and their mean F°,
///
///     r = (Σ_i ‖F_i − F°‖² / n)^(1/2).
///
/// As in the paper, each sample starts from the solution before it, so that the ensemble is a Monte Carlo
/// chain that drifts away from the packing's forces. With several chains, each starts from the packing's
/// forces; with as many chains as samples, all samples are single steps from there, and r is about half as
/// large. The samples have no known distribution over the polytope: they are what an iterative solver
/// reaches.
struct PerturbOptions {
  int samples = 500;
  double width = 0.5;
  int chains = 1;  ///< In 1 … samples. Chains run in parallel.
  std::uint64_t seed = 0;
  int threads = 1;  ///< Results do not depend on it.
  /// A solution is taken once balanced forces are this close to it (mg, norm over all contacts), or once the
  /// sweeps change it by less than the solver's tolerance.
  double distance = 0.3;
  StaticOptions solver = {.tolerance = tolerance::kSweepChange, .max_sweeps = 50000};
  PolishOptions polish = {};
  double accept_residual = tolerance::kAcceptedResidual;  ///< A polished solution is accepted if it balances,
                                                          ///< and lies in the cones, to this (mg).

  std::optional<std::string> defect() const;
};

/// One attempt. Forces in the packing's units.
struct PerturbSample {
  Eigen::VectorXd forces;
  bool accepted = false;
  bool converged = false;      ///< The iteration came close to balanced forces, or to rest.
  double raw_residual = -1;    ///< Before the polish (mg).
  double residual = -1;        ///< After it (mg).
  double cone_violation = -1;  ///< After it (mg).
  std::int64_t sweeps = 0;
};

struct PerturbEnsemble {
  std::vector<PerturbSample> samples;
  int accepted = 0;
  int converged = 0;
  double worst_raw_residual = 0;  ///< Of the accepted ones (mg).
  double worst_residual = 0;      ///< Of the accepted ones: balance and cones (mg).
  Eigen::VectorXd center;         ///< F°, in the packing's units.
  double r = -1;                  ///< mg; −1 without accepted samples.
  double r_error = -1;            ///< Standard error of r over the samples (mg).
  double spread = -1;             ///< Standard deviation of ‖F_i − F°‖ (mg).
  double start_distance = -1;     ///< ‖F_packing − F°‖ (mg).
};

/// Throws InputError if the packing's forces are unknown or a wall is loaded, or with the options' defect;
/// Interrupted if the callback asks to stop.
PerturbEnsemble perturb_and_resolve(const Packing& packing, const PerturbOptions& options,
                                    const ProgressCallback& progress = {});

}  // namespace indet::sim
