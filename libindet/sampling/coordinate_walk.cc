#include "libindet/sampling/coordinate_walk.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "libindet/base/lanes.h"

namespace indet {
namespace {

/// Slacks stay above this, so that quotients stay finite; a chord towards such a face has no length.
constexpr double kSmallestSlack = 1e-250;

struct Chord {
  double low, high;
};

/// Lanes that need not be aligned.
typedef double LooseLanes __attribute__((vector_size(16), aligned(8), may_alias));

Lanes lanes_at(const double* p) { return *reinterpret_cast<const LooseLanes*>(p); }

/// From the largest and the smallest a_k/s_k.
Chord chord(const double* a, const double* s, Eigen::Index count) {
  std::array<Lanes, 2> largest{both(0), both(0)};
  std::array<Lanes, 2> smallest = largest;
  Eigen::Index k = 0;
  for (; k + 3 < count; k += 4) {
    for (std::size_t i = 0; i < 2;
         ++i) {  // two chains of comparisons, so that one need not wait for the other
      const Eigen::Index place = k + 2 * static_cast<Eigen::Index>(i);
      const Lanes quotient = lanes_at(a + place) / lanes_at(s + place);
      largest[i] = larger(largest[i], quotient);
      smallest[i] = smaller(smallest[i], quotient);
    }
  }
  const Lanes highs = larger(largest[0], largest[1]);
  const Lanes lows = smaller(smallest[0], smallest[1]);
  double high = std::max(highs[0], highs[1]);
  double low = std::min(lows[0], lows[1]);
  for (; k < count; ++k) {
    high = std::max(high, a[k] / s[k]);
    low = std::min(low, a[k] / s[k]);
  }
  return {-1 / high, -1 / low};
}

void move(double* s, const double* a, double step, Eigen::Index count) {
  Eigen::Index k = 0;
  for (; k + 1 < count; k += 2) {
    const Lanes moved = lanes_at(s + k) + both(step) * lanes_at(a + k);
    *reinterpret_cast<LooseLanes*>(s + k) = larger(moved, both(kSmallestSlack));
  }
  if (k < count) s[k] = std::max(s[k] + step * a[k], kSmallestSlack);
}

}  // namespace

RoundedBody::RoundedBody(const ConvexBody& body, const Rounding& rounding)
    : slope(Eigen::MatrixXd::Zero(body.view.slope.rows(), body.view.slope.cols())),
      offset(body.view.offset + body.view.slope * rounding.center) {
  for (const BodyBlock& block : body.blocks) {
    const auto square =
        rounding.transform.block(block.first_column, block.first_column, block.columns, block.columns);
    slope.block(block.first_row, block.first_column, block.rows, block.columns) =
        body.view.slope.block(block.first_row, block.first_column, block.rows, block.columns) * square;
    block_of_column.insert(block_of_column.end(), static_cast<std::size_t>(block.columns), block);
  }
}

CoordinateWalk::CoordinateWalk(const RoundedBody& body, Eigen::VectorXd y, Random random)
    : body_(&body), y_(std::move(y)), random_(random) {
  refresh();
}

void CoordinateWalk::refresh() { slacks_ = (body_->offset + body_->slope * y_).cwiseMax(kSmallestSlack); }

void CoordinateWalk::sweep(double precision) {
  for (Eigen::Index j = 0; j < y_.size(); ++j) {
    const BodyBlock& block = body_->block_of_column[static_cast<std::size_t>(j)];
    const double* column = body_->slope.col(j).data() + block.first_row;
    double* slacks = slacks_.data() + block.first_row;
    Chord range = chord(column, slacks, block.rows);
    if (precision > 0) {
      const double reach = std::sqrt(y_[j] * y_[j] - 2 * std::log(1 - random_.uniform()) / precision);
      range.low = std::max(range.low, -reach - y_[j]);
      range.high = std::min(range.high, reach - y_[j]);
    }
    const double step = random_.uniform(range.low, range.high);
    y_[j] += step;
    move(slacks, column, step, block.rows);
  }
}

}  // namespace indet
