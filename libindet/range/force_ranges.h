#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "libindet/packing/packing.h"
#include "libindet/polytope/force_polytope.h"
#include "libindet/range/contact_choice.h"
#include "libindet/range/method.h"
#include "libindet/range/paper_work.h"

namespace indet {

/// What became of one objective.
enum class Outcome : std::uint8_t {
  kOptimal,      ///< Certified: recomputed vertex, residuals within tolerance.
  kUnbounded,    ///< The value is ±inf; a ray of the recession cone proves it.
  kImprecise,    ///< A value is given, but its residuals or the rank decision leave it uncertain.
  kFailed,       ///< No value was found (NaN).
  kNotRequested  ///< Left out by the user's choice of contacts (NaN), or there is no admissible state.
};

/// The four objectives of a contact, in the order of the columns of every [M,4] table.
enum Column : std::uint8_t { kMinR = 0, kMaxR = 1, kMinT = 2, kMaxT = 3 };

const char* to_string(Outcome outcome);
const char* to_string(Column column);  ///< "R_min", "R_max", "T_min", "T_max".

template <class T>
using Table4 = Eigen::Array<T, Eigen::Dynamic, 4, Eigen::RowMajor>;

/// The ranges of all contact forces of one packing. Forces (values, bounds, states, ray) are in the scene's
/// own units; residuals, δ [23], d [24], R*, T* [39] are dimensionless. M contacts, N disks, d the nullity.
/// Fields start at impossible values.
struct ForceRanges {
  static constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

  // The equilibrium problem.
  PolytopeStatus status = PolytopeStatus::kEmpty;
  int unknowns = -1;       ///< Columns of c that the scene needs: 2 a contact, 1 where μ = 0.
  int equations = -1;      ///< Rows of c that the scene needs.
  int rank = -1;           ///< rank c.
  int nullity = -1;        ///< d = dim ker c ≥ 2M − 3N [8].
  int dim = -1;            ///< dim F; −1 when F is empty.
  int blocks = -1;         ///< Independent parts of F.
  double rank_gap = kNaN;  ///< Smallest accepted over largest rejected singular value (estimates).
  double smallest_accepted = kNaN;
  double largest_rejected = kNaN;
  bool rank_ambiguous = false;
  /// Some decision about F (rank, emptiness, dimension, boundedness) lies within rounding: every result is
  /// imprecise.
  bool doubtful = false;
  double residual = kNaN;    ///< Largest ‖cF + w‖∞ over the stored states, in force units.
  double force_unit = kNaN;  ///< mg in the scene's units.
  int sliding =
      -1;  ///< Sliding contacts of the simulated state, non-transmitting ones counted twice; −1 if unknown.
  int non_transmitting = -1;  ///< Non-transmitting contacts of the simulated state; −1 if unknown.

  // The contacts that were asked for. All others have NaN, −1 and kNotRequested in every field below.
  ContactChoice::Kind choice = ContactChoice::Kind::kAll;
  int requested = -1;                 ///< How many contacts.
  std::int64_t sample_seed = -1;      ///< Of a sample.
  SampleEstimate sample_R, sample_T;  ///< δR and δT of all contacts, estimated from a sample.

  // One row a contact, columns R_min, R_max, T_min, T_max.
  Table4<double> value;         ///< ±inf where unbounded, NaN where not found.
  Table4<double> lower, upper;  ///< Enclosure of the value.
  /// How far the value moves, at most and to first order, when every normal turns by a small angle, over that
  /// angle (force per radian); NaN where there is no extremal state.
  Table4<double> sensitivity;
  Table4<Outcome> outcome;
  Table4<double> primal_residual, dual_residual;
  Table4<std::uint8_t> unique;  ///< 1: the extremal state is the only one that attains the value.
  Table4<std::int32_t> vertex;  ///< Row of `states`; −1: none.

  // One entry a contact.
  Eigen::VectorXd delta_R, delta_T;  ///< [23], +inf where unbounded.
  Eigen::VectorXd d_R, d_T;          ///< [24], NaN where an extremal state is missing.
  Eigen::VectorXd R_star,
      T_star;  ///< [39], NaN where the simulated force is unknown or the range is a point.

  // Extremal states, each once, in the order in which the table first points to them.
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> states;  ///< [K, 2M]
  Eigen::VectorXd norm;                                                           ///< [K], ‖F‖.
  /// [K, dim]: the half-planes that define the vertex: 2α for μR + T ≥ 0 and 2α + 1 for μR − T ≥ 0 of contact
  /// α (R ≥ 0 is 2α where μ = 0).
  Eigen::Array<std::int32_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> active;
  int largest_norm = -1;  ///< The state of largest norm.

  /// [Q, 2M]: directions of ker c ∩ K along which F is unbounded (largest entry 1).
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rays;
  Table4<std::int32_t>
      ray;  ///< Row of `rays` along which the objective grows without limit; −1: it is limited.

  Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>
      motion;  ///< [N, 3] virtual velocity x, y and r·ω of each disk when F is empty.

  // Work done.
  Method method = Method::kLp;
  std::string formulation;  ///< Of the linear programs, "" where a tableau did without.
  PaperWork paper;          ///< Only of Method::kPivotingPaper.
  std::int64_t objectives = 0, solves = 0, pivots = 0, determined = 0;
  std::int64_t certified = 0, imprecise = 0, failed = 0, unbounded = 0;
  double worst_primal_residual = kNaN, worst_dual_residual = kNaN;
  std::map<std::string, double> seconds;  ///< By stage.
};

}  // namespace indet
