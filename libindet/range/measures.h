#pragma once

#include <Eigen/Core>

#include "libindet/packing/packing.h"
#include "libindet/range/certify.h"
#include "libindet/range/contact_choice.h"
#include "libindet/range/extrema.h"
#include "libindet/range/problem_summary.h"
#include "libindet/statistics/draw_estimate.h"

namespace indet {

/// What follows from values, states and simulated forces: the last stage of an analysis. M contacts, K
/// states. δ [23], d [24], R*, T* [39] are dimensionless.
struct Measures {
  // One entry a contact.
  Eigen::VectorXd delta_R, delta_T;  ///< [23], +inf where unbounded.
  Eigen::VectorXd d_R, d_T;          ///< [24], NaN where an extremal state is not kept.
  Eigen::VectorXd R_star,
      T_star;             ///< [39], NaN where the simulated force is unknown or the range is a point.
  Eigen::VectorXd norm;   ///< [K], ‖F‖ of each state, in the scene's unit of force.
  int largest_norm = -1;  ///< The state of largest norm.
  /// Sliding contacts of the simulated state, non-transmitting ones counted twice; −1 if unknown.
  int sliding = -1;
  int non_transmitting = -1;          ///< Non-transmitting contacts of the simulated state; −1 if unknown.
  SampleEstimate sample_R, sample_T;  ///< δR and δT of all contacts, estimated from a sample.
  /// Of their means, where contacts were drawn with unequal probabilities.
  DrawEstimator estimator = DrawEstimator::kMean;
};

/// Distances of extremal states [24], in mg; NaN where one is missing.
struct StateDistances {
  Eigen::VectorXd d_R, d_T;  ///< One entry a contact.
};

/// `vertex`: rows of `states`, which are in the scene's units.
StateDistances state_distances(const Rows<double>& states, const Table4<std::int32_t>& vertex,
                               double force_unit);

/// Norms and distances of the states that are there: norm, largest_norm, d_R, d_T.
void measure_states(const ExtremalStates& extremal, double force_unit, Measures& measures);

/// An estimate from a sample is NaN if one of its ranges was not found, or there is none. From contacts drawn
/// with unequal probabilities means are found by regression on what the widths predict
/// (width_predictions.h).
Measures measure(const Packing& packing, const ProblemSummary& problem, const ContactRequest& request,
                 const ExtremalStates& extremal, const Certified& certified);

}  // namespace indet
