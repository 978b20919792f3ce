#pragma once

#include <optional>
#include <string>
#include <vector>

#include "libsim/simulate.h"

namespace indet::sim {

/// Gravity turned slowly until disks move:
///
///     g(t) = g cos θ + g⊥ sin θ,   θ = ω t,   g⊥ = (−g_y, g_x): counter-clockwise positive,
///
/// from the state at rest that a packing is in, with the forces that its contacts remember. A disk has moved
/// once its centre is further than d from where it was before gravity turned.
///
/// What yields at θ_c accelerates by c g (θ − θ_c), with c about 1 (1 for a disk that slides without
/// friction, 2/3 for one that rolls), and has moved by d at an angle that is too large by
///
///     δ = (6 d ω²/(c g))^(1/3)
///
/// (rad). With r_max and √(r_max/g) as units, d = 0.001 and ω = 0.02° a unit of time, δ = 0.05°.
struct TiltOptions {
  double rate = 0;          ///< ω, rad a unit of time (world.h), not 0; negative: clockwise.
  double angle_limit = 0;   ///< rad, > 0: |θ| ends there.
  int most_moved = 1;       ///< It ends once so many disks have moved.
  double distance = 1e-3;   ///< d, r_max: above what springs yield, below most gaps that can close.
  double row_interval = 0;  ///< rad, > 0: of the rows.

  std::optional<std::string> defect(const World& world) const;
};

/// The state at one angle.
struct TiltRow {
  double angle = 0;  ///< rad
  /// M, R ≥ ε, and M_s, of these those with μR − |T| < ε, by the forces of the last step, damping included.
  /// ε is tolerance::kSliding (mg); of springs, whose forces lag behind, ten times the residual that counts
  /// as rest.
  int contacts = 0;
  int sliding = 0;
  double kinetic_energy = 0;  ///< Per disk, mg r_max.
  double displacement = 0;    ///< Largest of all disks, r_max.
};

struct Tilt {
  /// The last of the states at the rows that comes to rest when gravity turns no further, with fewer than
  /// most_moved disks that have moved, polished; gravity is the turned one.
  Simulation rest;
  double rest_angle = 0;         ///< rad
  std::vector<double> moved_at;  ///< Of each disk: the angle at which it first had moved, NaN: never. rad
  std::vector<TiltRow> rows;     ///< The first at θ = 0, the last where it ended.
  int moved = 0;                 ///< Disks that have moved.
  double start_distance = 0;  ///< Between the packing's forces and those at rest before gravity turned, mg.
  StepperReport report;       ///< Of the steps during which gravity turned.

  double angle() const { return rows.back().angle; }
};

/// Tilts a packing. Before, it comes to rest in this simulator, which changes nothing of a packing that the
/// same simulator made. Throws InputError with a defect of the options, or if the packing does not come to
/// rest or a disk moves by the distance before gravity turns; Interrupted.
///
/// `listener`: progress and frames; checkpoints are not made.
Tilt tilt(const Packing& packing, const Friction& friction, const SimulationOptions& options,
          const TiltOptions& how, const Listener& listener = {});

}  // namespace indet::sim
