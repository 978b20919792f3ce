#pragma once

#include <vector>

#include "libindet/base/lanes.h"
#include "libsim/force_law.h"
#include "libsim/neighbours.h"
#include "libsim/stepper.h"

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
  void set_gravity(const Vector2& gravity) override;
  double dt() const override { return dt_; }
  const World& world() const override { return world_; }
  std::vector<ContactState> state() const override;
  std::vector<ContactState> forces() const override;
  StepperReport report() const override { return report_; }

 private:
  /// All that the loops need of a disk, side by side, in pairs of doubles (lanes.h). 96 bytes.
  struct Body {
    Lanes x{0, 0};
    Lanes v{0, 0};
    Lanes turn{0, 0};   ///< Surface speed r ω, and r.
    Lanes force{0, 0};  ///< Sum.
    double t = 0;       ///< Sum of tangential forces: the torque divided by r.
    // What one step adds to the velocities per unit of force.
    double per_force = 0, per_torque = 0;
    double rolled = 0;  ///< Arc length turned since the angle was last stored.
  };
  /// Two disks that may touch. Pointers into bodies_, which never grows: indices would cost the pair loop a
  /// sixth of its instructions.
  struct Pair {
    Body* a;
    Body* b;
  };
  struct WallPair {
    int disk, wall;
    double arm;  ///< l/r
  };
  /// Two disks that may touch with levers of their own: rare, so that they are kept out of the pair loop.
  struct LeverPair {
    int a, b;
    Arms arms;
    double spring;
  };
  struct Load {
    Lanes force;
    double t;
  };

  template <bool kFriction>
  void advance_as(int steps);
  template <bool kFriction>
  void add_wall_forces();
  template <bool kFriction>
  void add_pair_forces();
  template <bool kFriction>
  void add_lever_pair_forces();
  /// Kick and drift; returns the largest |v|². With kHeld some disks are fixed.
  template <bool kFriction, bool kHeld>
  double move();
  void load();
  void store();
  void add_loads();
  /// The skin that the present speeds ask for.
  double suitable_skin() const;
  /// Makes new neighbour lists if they may have become incomplete; springs move to their new places.
  void refresh_neighbours();
  /// Takes the lists over and gives each pair the spring of its contact; sorted as in state().
  void place_springs(const std::vector<ContactState>& contacts);

  World world_;
  SpringLaw law_;
  double dt_;
  NeighbourList neighbours_;
  double path_ = 0;  ///< No disk has moved further than this since the lists were made.
  /// The last two rows belong to no disk and never touch: they fill up pairs_, whose number is even.
  std::vector<Body> bodies_;
  Lanes fall_{0, 0};         ///< What gravity adds to the velocity in a step.
  std::vector<Load> loads_;  ///< Of each disk; empty if there are none.
  std::vector<Pair> pairs_;
  std::vector<WallPair> wall_pairs_;
  std::vector<LeverPair> lever_pairs_;          ///< Sorted by a and b.
  bool held_ = false;                           ///< Some disks are fixed.
  std::vector<double> springs_, wall_springs_;  ///< One for each pair.
  StepperReport report_;
};

/// An upper bound of the largest eigenvalue of M⁻¹ Σ (n̂n̂ᵀ + t̂t̂ᵀ) over all contacts that these disks can have
/// at once: 2 max_i z_i max(1/m_i, α² r_i²/I_i), where z_i disks of the smallest radius fit around disk i,
/// and α r is the longest lever.
double stiffness_factor(const World& world);

/// The leapfrog step is stable if 2 dt κγ + dt² κk < 4 with κ = stiffness_factor(world); the dt of equality.
double largest_explicit_step(const World& world, const SpringLaw& law);

}  // namespace indet::sim
