#pragma once

#include <vector>

#include "indet/sim/force_law.h"
#include "indet/sim/neighbours.h"
#include "indet/sim/stepper.h"

namespace indet::sim {

/// Molecular dynamics with the forces of force_law.h taken at the start of each step (leapfrog):
///
///     v_{n+1/2} = v_{n−1/2} + dt M⁻¹ (w + c F(x_n, v_{n−1/2})),    x_{n+1} = x_n + dt v_{n+1/2}.
///
/// Positions are accurate to O(dt²) without damping, and energy does not drift. The velocities of `world()`
/// are those half a step before its positions.
class ExplicitStepper : public Stepper {
 public:
  /// Precondition: dt ≤ largest_explicit_step(world, law).
  ExplicitStepper(World world, const std::vector<ContactState>& contacts, const SpringLaw& law, double dt);

  void advance(int steps) override;
  double dt() const override { return dt_; }
  const World& world() const override { return world_; }
  std::vector<ContactState> state() const override;
  std::vector<ContactState> forces() const override;
  StepperReport report() const override { return report_; }

 private:
  struct Body {
    double x, y, vx, vy;
    double s;  ///< Surface speed r ω.
    double r;
    double rolled;  ///< Arc length turned since the angle was last stored.
  };
  struct Force {
    double x, y, t;  ///< Sums of forces; t: of tangential forces, the torque divided by r.
  };
  /// What one step adds to the velocities per unit of force.
  struct Kick {
    double per_force, per_torque;
  };

  template <bool kFriction>
  void advance_as(int steps);
  template <bool kFriction>
  void add_forces();
  /// Kick and drift; returns the largest |v|².
  template <bool kFriction>
  double move();
  void load();
  void store();
  /// Makes new neighbour lists if they may have become incomplete; springs move to their new places.
  void refresh_neighbours();
  /// Copies the springs of the contacts, sorted as in state(), to the lists' places.
  void place_springs(const std::vector<ContactState>& contacts);

  World world_;
  SpringLaw law_;
  double dt_;
  NeighbourList neighbours_;
  double path_ = 0;  ///< No disk has moved further than this since the lists were made.
  std::vector<Body> bodies_;
  std::vector<Force> forces_;
  std::vector<Kick> kicks_;
  Vector2 fall_{0, 0};                          ///< What gravity adds to the velocity in a step.
  std::vector<Force> loads_;                    ///< Of each disk; empty if there are none.
  std::vector<double> springs_, wall_springs_;  ///< One for each listed pair.
  StepperReport report_;
};

/// An upper bound of the largest eigenvalue of M⁻¹ Σ (n̂n̂ᵀ + t̂t̂ᵀ) over all contacts that these disks can have
/// at once: 2 max_i z_i max(1/m_i, r_i²/I_i), where z_i disks of the smallest radius fit around disk i.
double stiffness_factor(const World& world);

/// The leapfrog step is stable if 2 dt κγ + dt² κk < 4 with κ = stiffness_factor(world); the dt of equality.
double largest_explicit_step(const World& world, const SpringLaw& law);

}  // namespace indet::sim
