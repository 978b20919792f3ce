#pragma once

#include <array>
#include <span>
#include <vector>

#include "libsim/sweep.h"
#include "libsim/sweep_order.h"

namespace indet::sim {

/// Non-linear Gauss–Seidel for a set of frictional contacts.
///
/// Unknowns are the impulses p = (p_n, p_t) of each contact; v = v_free + M⁻¹ c p are the velocities of the
/// bodies after them. With the relative velocity u of a with respect to b at the contact, each contact must
/// satisfy
///
///     u_n + C p_n + b_n ≥ 0,  p_n ≥ 0,  one of them 0                      (unilateral contact)
///     u_t + C p_t + b_t = 0 where |p_t| < μ p_n, else opposed to p_t      (Coulomb)
///
/// C ≥ 0 is a compliance: 0 for rigid bodies, 1/(dt(γ + k dt)) for springs with dashpots
/// (implicit_stepper.h). Torque on every disk is + l T, so that with the surface speed s = r ω of each disk
/// and the arms α = l/r, mostly 1,
///
///     u_n = n̂·(v_a − v_b),   u_t = t̂·(v_a − v_b) + α_a s_a + α_b s_b,
///     W_nn = 1/m_a + 1/m_b,  W_tt = W_nn + α_a² r_a²/I_a + α_b² r_b²/I_b,  W_nt = 0.
///
/// Because W_nt = 0, one contact alone is solved exactly by two projections:
///
///     p_n ← max(0, p_n − (u_n + C p_n + b_n)/(W_nn + C)),
///     p_t ← clamp(p_t − (u_t + C p_t + b_t)/(W_tt + C), ±μ p_n).

/// Velocities of one body; a wall and a fixed disk have inverse masses 0 and velocity 0.
struct SolverBody {
  double vx = 0, vy = 0;
  double s = 0;  ///< Surface speed r ω.
};

struct SolverContact {
  int a = 0, b = 0;       ///< Rows of the body array.
  double nx = 0, ny = 0;  ///< n̂, from b to a.
  double p_n = 0, p_t = 0;
  double bias_n = 0, bias_t = 0;
  double compliance = 0;
  double scale_n = 0, scale_t = 0;  ///< 1/(W_nn + C), 1/(W_tt + C); set by `prepare`.
  double mu = 0;
  double inverse_mass_a = 0, inverse_mass_b = 0;
  double inverse_spin_a = 0, inverse_spin_b = 0;  ///< r²/I.
  double arm_a = 1, arm_b = 1;                    ///< α

  /// Fills scale_n and scale_t from the inverse masses and the compliance.
  void prepare();
};

struct SweepLimits {
  int max_sweeps = 300;
  /// Stop once no component of any impulse changes by more than this (impulse) in a sweep. ≥ 0; the distance
  /// to the solution is larger by about the number of sweeps over which information spreads (10–1000).
  double tolerance = 0;
};

struct SweepReport {
  int sweeps = 0;
  double change = 0;  ///< Largest change of an impulse component in the last sweep.
  bool converged = false;
};

/// Adds the impulses that the contacts carry to the velocities: to be called once before solving.
void apply_impulses(std::span<const SolverContact> contacts, std::span<SolverBody> bodies);

/// Sweeps over the contacts in the order of sweep_order.h (sweep.h). The order is kept from one
/// solution to the next as long as the contacts are between the same bodies.
class ContactSolver {
 public:
  /// Sweeps until `limits` are met. If no contact has friction, tangential components and surface speeds are
  /// left out altogether.
  SweepReport solve(std::span<SolverContact> contacts, std::span<SolverBody> bodies,
                    const SweepLimits& limits);

 private:
  void load(std::span<const SolverContact> contacts, std::span<const SolverBody> bodies);
  void store(std::span<SolverContact> contacts, std::span<SolverBody> bodies) const;

  std::vector<ContactEnds> ends_;
  /// Contact in each place of the groups, −1 where there is none.
  std::vector<std::array<int, 4>> order_;
  std::vector<ContactGroup> groups_;
  /// One for each body, and spare ones at the end.
  std::vector<VelocityRow> rows_;
};

}  // namespace indet::sim
