#pragma once

#include <optional>
#include <vector>

#include "libindet/base/tolerances.h"
#include "libsim/contact_solver.h"
#include "libsim/force_law.h"
#include "libsim/neighbours.h"
#include "libsim/stepper.h"

namespace indet::sim {

/// Moreau's time stepping: contact forces act implicitly over each step, velocities jump.
///
///     v⁺ = v + dt M⁻¹ w + M⁻¹ c p,    x⁺ = x + dt v⁺,
///
/// with the impulses p of contact_solver.h. Two laws give its bias and compliance; g is the gap at the start
/// of the step.
///
/// Rigid (contact dynamics), C = 0:
///     b_n = g/dt (g > 0: it may close in this step), α g/dt (g ≤ 0: a fraction α of an overlap is removed),
///     b_t = e_t u_t⁻. With restitution e_n > 0 bodies must touch (g ≤ 0) to collide, and
///     b_n = min(e_n u_n⁻, α g/dt), so that they leave with at least −e_n u_n⁻.
///
/// Springs with dashpots (molecular dynamics), R = −k g⁺ − γ u_n⁺ with g⁺ = g + dt u_n⁺ and R ≥ 0, and
/// likewise T = −k_t ξ⁺ − γ_t u_t⁺ with ξ⁺ = ξ + dt u_t⁺: dividing by dt (γ + k dt),
///     C = 1/(dt (γ + k dt)),  b_n = k g/(γ + k dt) (g ≤ 0), g/dt (g > 0),  b_t = k_t ξ/(γ_t + k_t dt).
/// This is the implicit Euler step of the spring law (force_law.h; k_t = k, γ_t = γ), stable for any dt.
struct RigidLaw {
  /// Fraction of an overlap that is removed a step, in [0, 1]. 0: overlaps are left alone. Above, the disks
  /// creep apart for thousands of steps, which rebuilds the forces and holds contacts at their Coulomb limit
  /// (docs/decisions/overlaps-left-alone.md).
  double alpha = 0;
  double restitution_n = 0;  ///< e_n in [0, 1].
  double restitution_t = 0;  ///< e_t in [0, 1].
};

struct ImplicitOptions {
  double dt = 0;                     ///< Scene's own unit of time.
  std::optional<SpringLaw> springs;  ///< Without: rigid.
  RigidLaw rigid;
  int max_sweeps = 100;  ///< A step.
  /// The same for a step in which no contact carries a force from the step before: there, sweeps start from
  /// F = 0, far from a solution.
  int start_sweeps = 100;
  double tolerance =
      tolerance::kSweepChange;  ///< Largest change of a contact force in a sweep, in units of force (mg).
  /// The tolerance is loosened to this fraction of the largest change of a contact force in the previous
  /// step: while forces change by 1 mg a step, an error of 1e-3 mg is of no account. Springs correct it in
  /// the next step; rigid contacts do not.
  double loosening = 0;
};

class ImplicitStepper : public Stepper {
 public:
  ImplicitStepper(World world, std::vector<ContactState> contacts, const ImplicitOptions& options);

  void advance(int steps) override;
  void set_gravity(const Vector2& gravity) override { world_.gravity = gravity; }
  double dt() const override { return options_.dt; }
  const World& world() const override { return world_; }
  std::vector<ContactState> state() const override;
  std::vector<ContactState> forces() const override;
  StepperReport report() const override { return report_; }

 private:
  void step();
  void find_contacts();
  void add_contact(int a, int b, double nx, double ny, double gap, double mu);
  /// Takes impulses and springs over from the contacts of the previous step; returns whether there were any.
  bool carry_over();
  void finish();

  World world_;
  ImplicitOptions options_;
  NeighbourList neighbours_;
  double force_unit_ = 1;
  bool starts_from_zero_ = true;  ///< No contact of this step carries an impulse.
  double reach_ = 0;
  double near_gap_ = 0;  ///< Gaps up to this count as possible contacts even at rest.

  std::vector<SolverBody> bodies_;
  std::vector<double> inverse_mass_, inverse_spin_;
  std::vector<double> speed_;
  std::vector<SolverContact> solver_;
  ContactSolver gauss_seidel_;
  std::vector<ContactState>
      contacts_;  ///< One for each entry of solver_ during a step; those with R > 0 after it.
  std::vector<ContactState> previous_;
  StepperReport report_;
};

}  // namespace indet::sim
