#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "libindet/packing/packing.h"
#include "libindet/range/outcome.h"

namespace indet {

/// Of which contacts a result by the barrier method keeps what proves their values.
struct DualChoice {
  enum class Kind : std::uint8_t {
    kNone,
    kSample,  ///< `sample_size` of those whose ranges are asked for, drawn with the seed
    kAll      ///< all of these
  };
  Kind kind = Kind::kNone;
  int sample_size = 0;
  std::uint64_t seed = 1;
};

/// The contacts of the choice among `asked_for` (ascending), ascending.
std::vector<int> contacts_with_duals(const DualChoice& choice, const std::vector<int>& asked_for);

/// What proves values, without trust in what found them. D contacts, 4 values each. Multipliers y are told of
/// the *scene's rows*, which are there whether a scene needs them or not (0, where it does not):
///
///   3N   of each disk the balance of force along x, along y, and of torque over its radius
///   2W   of each wall, if it is loaded, the balance along its normal and its tangent
///   3    of the cell, if stress is imposed, xx (or the pressure), yy and xy
///   B    of force_bounds() in their order:  F − s = lo,  F + s = hi,  F = value
///
/// in this order, Y = 3N + 2W + 3 + B, and belong to A x = b, x ≥ 0 on all edges of the scene's cones and the
/// slacks s. A value is c·x, and y has no unit: to first order, y_i is how much the value grows with b_i
/// (minus the load). By weak duality, with h = c − Aᵀ y and X_k ≥ x_k,
///
///   minimum ≥ b·y + Σ_k min(0, h_k) X_k,   maximum ≤ b·y + Σ_k max(0, h_k) X_k
///
/// and from the other side a state bounds it, at which it is c·x itself.
struct Duals {
  std::int64_t seed = -1;                                  ///< that drew the contacts; −1: all have them
  Eigen::Array<std::int32_t, Eigen::Dynamic, 1> contacts;  ///< [D], ascending
  Rows<double> multipliers;  ///< [4D, Y]: y of R_min, R_max, T_min, T_max of the first contact, …
  Rows<double> points;       ///< [4D, 2M]: states close to these values, in the scene's unit of force
  Eigen::VectorXd bounding;  ///< [Y]: ŷ with Aᵀ ŷ > 0, from which X_k = b·ŷ / (Aᵀ ŷ)_k

  bool are_kept() const { return contacts.size() > 0; }
  /// The row of a value of the d-th contact.
  static Eigen::Index row_of(Eigen::Index d, int column) { return 4 * d + column; }
};

/// Bytes that the duals of so many contacts take.
std::size_t dual_bytes(const Packing& packing, std::size_t contacts);

}  // namespace indet
