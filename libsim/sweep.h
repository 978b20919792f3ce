#pragma once

#include <array>
#include <span>

#include "libindet/base/lanes.h"

namespace indet::sim {

/// Sweeps of Gauss–Seidel over contacts (contact_solver.h), four at a time.

/// Four doubles that are worked on at once: lanes 0, 1 and 2, 3. The same rounding as that of plain doubles.
struct alignas(32) FourLanes {
  Lanes low{0, 0}, high{0, 0};
  double operator[](std::size_t lane) const { return lane < 2 ? low[lane] : high[lane - 2]; }
  void set(std::size_t lane, double value) {
    // Not through a conditional operator: g++ 12 loses lane 3 of that with -fsanitize=bounds.
    if (lane < 2) {
      low[lane] = value;
    } else {
      high[lane - 2] = value;
    }
  }
};

/// Four contacts side by side that share no moving body, and the rows of their bodies.
struct ContactGroup {
  std::array<int, 4> a{}, b{};
  FourLanes nx, ny;
  FourLanes p_n, p_t;
  FourLanes bias_n, bias_t;
  FourLanes compliance;
  FourLanes scale_n, scale_t;
  FourLanes mu;
  FourLanes inverse_mass_a, inverse_mass_b;
  FourLanes turn_a, turn_b;  ///< α r²/I
  FourLanes arm_a, arm_b;    ///< α
};

/// Velocity x, y and surface speed of a body; the last one is not used.
struct alignas(32) VelocityRow {
  Lanes v{0, 0};
  Lanes s{0, 0};
};

/// What a sweep can leave out, and whether it measures.
struct SweepParts {
  bool friction = true;  ///< False: no contact has friction.
  bool arms = true;      ///< False: all arms α are 1.
  bool offset = true;    ///< False: no contact has compliance or bias.
  bool measure = true;
};

/// One sweep over all groups. Returns the largest change of an impulse component, or 0 without `measure`.
/// Where the processor has registers of four doubles (AVX2) they are used; results are the same bits.
double sweep(SweepParts parts, std::span<ContactGroup> groups, std::span<VelocityRow> rows);

/// The same with registers of two doubles, which every processor has that the program is compiled for.
double sweep_in_pairs(SweepParts parts, std::span<ContactGroup> groups, std::span<VelocityRow> rows);

}  // namespace indet::sim
