#include "libindet/range/contact_draw.h"

#include <algorithm>
#include <cmath>

#include "libindet/base/random.h"

namespace indet {
namespace {

constexpr double kSteps = 100;           ///< of n_i, to the mean of a width
constexpr std::int32_t kLeastSteps = 2;  ///< of any n_i: no contact is out of reach

}  // namespace

std::vector<std::int32_t> draw_weights(
    const Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>& width) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(width.rows());
  for (Eigen::Index k = 0; width.rows() > 0 && k < width.cols(); ++k) {
    if (const double mean = width.col(k).mean(); mean > 0) sum += width.col(k) / mean;
  }
  std::vector<std::int32_t> weights;
  for (const double relative : sum)
    weights.push_back(kLeastSteps + static_cast<std::int32_t>(std::lround(kSteps * relative)));
  return weights;
}

std::vector<std::int32_t> draw_with_replacement(const std::vector<std::int32_t>& weight, int draws,
                                                std::uint64_t seed) {
  std::vector<std::int64_t> up_to;
  for (const std::int32_t n : weight) up_to.push_back((up_to.empty() ? 0 : up_to.back()) + n);
  std::vector<std::int32_t> drawn(weight.size(), 0);
  Random random(seed);
  for (int k = 0; k < draws; ++k) {
    const auto number = static_cast<std::int64_t>(random.below(static_cast<std::uint64_t>(up_to.back())));
    const auto found = std::upper_bound(up_to.begin(), up_to.end(), number);
    ++drawn[static_cast<std::size_t>(found - up_to.begin())];
  }
  return drawn;
}

ContactDraw draw_contacts(const ForcePolytope& polytope, int draws, std::uint64_t seed) {
  ContactDraw draw;
  static_cast<CentralWidths&>(draw) = central_widths(polytope);
  const Eigen::Index count = draw.width.rows();
  draw.draws = draws;
  const std::vector<std::int32_t> weight = draw_weights(draw.width);
  const std::vector<std::int32_t> drawn = draw_with_replacement(weight, draws, seed);
  draw.weight = Eigen::Map<const Eigen::Array<std::int32_t, Eigen::Dynamic, 1>>(weight.data(), count);
  draw.drawn = Eigen::Map<const Eigen::Array<std::int32_t, Eigen::Dynamic, 1>>(drawn.data(), count);
  return draw;
}

}  // namespace indet
