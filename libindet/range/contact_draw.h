#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "libindet/range/central_widths.h"

namespace indet {

/// Contacts drawn at random with unequal probabilities, for estimates of the mean of δR and of δT that need
/// few of them: δ is roughly proportional to the width σ of the Dikin ellipsoid about the analytic centre
/// (barrier/dikin_widths.h), so that contacts are drawn with probabilities
///
///   p_i = n_i / Σ n,   n_i = 2 + round(100 (σ_R,i / mean σ_R + σ_T,i / mean σ_T)),
///
/// one draw after the other, with replacement. The same draw serves R and T. n is whole, and its sums and
/// the draws are exact: the last digits of σ, which differ between machines, do not matter, unless one lies
/// within them of the middle between two whole numbers. A width whose mean is 0 is left out of n.
struct ContactDraw : CentralWidths {
  int draws = 0;  ///< K; 0: contacts were not drawn in this way, and the tables of it have no rows.
  Eigen::Array<std::int32_t, Eigen::Dynamic, 1> weight;  ///< [M], n_i.
  Eigen::Array<std::int32_t, Eigen::Dynamic, 1> drawn;   ///< [M], how often each contact was drawn.
};

/// n_i of widths [M, 2], both ≥ 0.
std::vector<std::int32_t> draw_weights(
    const Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>& width);

/// How often each is drawn in `draws` draws with probabilities n_i / Σ n; the same seed gives the same on any
/// machine. Precondition: n_i > 0.
std::vector<std::int32_t> draw_with_replacement(const std::vector<std::int32_t>& weight, int draws,
                                                std::uint64_t seed);

/// Draws contacts. Preconditions: polytope.central; draws > 0.
ContactDraw draw_contacts(const ForcePolytope& polytope, int draws, std::uint64_t seed);

}  // namespace indet
