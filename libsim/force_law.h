#pragma once

#include <algorithm>
#include <vector>

#include "libsim/world.h"

namespace indet::sim {

/// Linear springs with dashpots, in the normal and the tangential direction; stiffness and damping in the
/// scene's own units. With the gap g (< 0: overlap), the relative velocity u and the stretch ξ of the
/// tangential spring,
///
///     R = max(0, −k g − γ u_n),     T = −k ξ − γ u_t  limited to |T| ≤ μ R,     dξ/dt = u_t.
///
/// Where the limit acts, the contact slides and its spring stays at its greatest stretch, k |ξ| = μ R.
/// Without damping and friction, R = −dU/dg with U = k g²/2.
struct SpringLaw {
  double k = 0;
  double gamma = 0;

  double normal_force(double gap, double u_n) const { return std::max(0.0, -k * gap - gamma * u_n); }

  struct Tangential {
    double T;
    double spring;
    bool sliding;
  };
  Tangential tangential_force(double spring, double u_t, double limit) const {
    const double trial = -k * spring - gamma * u_t;
    if (trial > limit) return {limit, -limit / k, true};
    if (trial < -limit) return {-limit, limit / k, true};
    return {trial, spring, false};
  }
};

/// R and T without their damping parts, at the world's positions: what remains of them at rest. Contacts that
/// do not overlap are left out.
std::vector<ContactState> elastic_forces(const World& world, const std::vector<ContactState>& contacts,
                                         double k);

}  // namespace indet::sim
