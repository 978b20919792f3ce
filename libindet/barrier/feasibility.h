#pragma once

#include <cstdint>
#include <vector>

#include "libindet/barrier/block_cholesky.h"
#include "libindet/barrier/block_structure.h"

namespace indet::barrier {

/// What the set {A x = b, x ≥ 0} is, by Farkas' alternative in its strictly complementary form (Goldman and
/// Tucker 1956): there is a virtual motion y, Aᵀ y ≥ 0, b·y ≤ 0, and either
///
///   b·y < 0: the load does work along the motion, which no edge resists, and the set is empty; or
///   b·y = 0: some x of the set is positive exactly on the edges along which (Aᵀ y)_k = 0. Where
///            (Aᵀ y)_k > 0, x_k = 0 in every state: the edge is closed.
///
/// Found by one run of the homogeneous self-dual method (self_dual.h). What it says is then checked on its
/// own terms, whatever the iteration did: x > 0 is mended until A x = b but for rounding, y until it rests on
/// the edges that are open.
struct Feasibility {
  enum class Kind : std::uint8_t {
    kInterior,  ///< `x` > 0 solves A x = b
    kClosed,    ///< there are states, and `closed` edges that carry nothing in any
    kEmpty,     ///< no state
    kUndecided  ///< the alternatives are too close to each other for double precision
  };
  Kind kind = Kind::kUndecided;
  std::vector<double> x;    ///< a state, positive on the edges that are open; empty if kEmpty or kUndecided
  std::vector<double> y;    ///< the motion, in the structure's order, largest entry 1; if kClosed or kEmpty
  std::vector<int> closed;  ///< columns, ascending; if kClosed
  /// How clear the decision is: the smallest ratio between the two sides of any pair of strict
  /// complementarity (SelfDualPoint::margin).
  double margin = 0;
  int iterations = 0;
};

/// Precondition: the rows of the structure are independent.
Feasibility find_feasibility(const BlockStructure& structure, BlockCholesky& cholesky);

/// Whether the cone {A x = 0, x ≥ 0} has a ray, and with it every set {A x = b, x ≥ 0} that is not empty:
/// the same alternative. Either a y with Aᵀ y ≥ 1 bounds every strength by x_k ≤ b·y, or there is a ray.
struct Boundedness {
  bool decided = false;
  bool bounded = false;
  std::vector<double> y;    ///< if bounded; in the structure's order
  std::vector<double> ray;  ///< if unbounded: Σ = 1, of maximal support, exactly 0 on edges that are limited
  double margin = 0;
  int iterations = 0;
};

/// Precondition as above.
Boundedness find_boundedness(const BlockStructure& structure, BlockCholesky& cholesky);

}  // namespace indet::barrier
