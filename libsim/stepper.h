#pragma once

#include <cstdint>
#include <vector>

#include "libsim/world.h"

namespace indet::sim {

/// What happened so far, for progress and for the decision that the state is static.
struct StepperReport {
  std::int64_t steps = 0;
  std::int64_t capped_steps = 0;  ///< Steps whose contact iteration stopped at its limit of sweeps.
  std::int64_t sweeps = 0;
  std::int64_t contact_updates = 0;
  int contacts = 0;  ///< That transmit force.
};

/// One way of moving a world through time.
class Stepper {
 public:
  Stepper() = default;
  Stepper(const Stepper&) = delete;
  Stepper& operator=(const Stepper&) = delete;
  virtual ~Stepper() = default;

  virtual void advance(int steps) = 0;
  /// Gravity of the steps from here on.
  virtual void set_gravity(const Vector2& gravity) = 0;
  virtual double dt() const = 0;
  virtual const World& world() const = 0;
  /// The memory of the contacts, in the order of the bodies: with the world all that a new stepper needs to
  /// go on with the same bytes.
  virtual std::vector<ContactState> state() const = 0;
  /// The contact forces of the current positions. Springs: their elastic part alone, which is what remains at
  /// rest; a state counts as static when these balance.
  virtual std::vector<ContactState> forces() const = 0;
  virtual StepperReport report() const = 0;
};

}  // namespace indet::sim
