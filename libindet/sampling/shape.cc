#include "libindet/sampling/shape.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "libindet/base/constants.h"
#include "libindet/base/error.h"
#include "libindet/dense/symmetric.h"
#include "libindet/lp/lp_solver.h"
#include "libindet/lp/purification.h"
#include "libindet/lp/vertex.h"
#include "libindet/sampling/random_streams.h"
#include "libindet/statistics/bootstrap.h"

namespace indet {
namespace {

/// Finds the point of a body that lies farthest along a direction, block by block.
class Support {
 public:
  Support(const ConvexBody& body, const Eigen::VectorXd& interior, const LpOptions& options)
      : body_(body), interior_(interior) {
    for (const BodyBlock& block : body.blocks) {
      SlopeView& view = sets_.emplace_back();
      view.slope = body.view.slope.block(block.first_row, block.first_column, block.rows, block.columns);
      view.offset = body.view.offset.segment(block.first_row, block.rows);
    }
    for (const SlopeView& view : sets_)
      solvers_.push_back(std::make_unique<LpSolver>(view, Formulation::kDual, options));
  }

  /// None if a linear program could not be solved.
  std::optional<Eigen::VectorXd> farthest(const Eigen::VectorXd& direction) {
    Eigen::VectorXd z(body_.dim());
    for (std::size_t b = 0; b < sets_.size(); ++b) {
      const BodyBlock& block = body_.blocks[b];
      Objective objective;
      objective.along_z = direction.segment(block.first_column, block.columns);
      if (objective.along_z.norm() == 0) objective.along_z[0] = 1;  // any point will do
      const Basis start =
          purify_to_vertex(sets_[b], interior_.segment(block.first_column, block.columns), objective.along_z);
      const LpAnswer answer = solvers_[b]->maximise(objective, start);
      if (answer.status != LpStatus::kOptimal) return std::nullopt;
      z.segment(block.first_column, block.columns) = compute_vertex(sets_[b], answer.basis).z;
    }
    return z;
  }

 private:
  const ConvexBody& body_;
  Eigen::VectorXd interior_;
  std::vector<SlopeView> sets_;
  std::vector<std::unique_ptr<LpSolver>> solvers_;
};

/// The largest distance that is met when one goes from a point to the farthest one, again and again.
double large_distance(const Eigen::MatrixXd& points) {
  constexpr Eigen::Index kStarts = 64;
  double largest = 0;
  const Eigen::Index starts = std::min(kStarts, points.cols());
  for (Eigen::Index start = 0; start < starts; ++start) {
    Eigen::Index i = start * points.cols() / starts;
    for (double reached = -1;;) {
      Eigen::Index next = 0;
      const double distance =
          std::sqrt((points.colwise() - points.col(i)).colwise().squaredNorm().maxCoeff(&next));
      largest = std::max(largest, distance);
      if (!(distance > reached)) break;
      reached = distance;
      i = next;
    }
  }
  return largest;
}

double range_diagonal(const ForceRanges& ranges) {
  const double squares = ranges.delta_R.squaredNorm() + ranges.delta_T.squaredNorm();
  return std::sqrt(squares);
}

}  // namespace

PolytopeShape measure_shape(const ConvexBody& body, const UniformSample& sample, const ForceRanges* ranges,
                            const ShapeOptions& options) {
  const int n = body.dim();
  PolytopeShape shape;
  const double unit =
      body.units.internal_in_weights();  // z and all lengths are in the internal unit until the end
  shape.inscribed_radius = unit * sample.ball.radius;
  const Eigen::MatrixXd centred = sample.z.colwise() - sample.z.rowwise().mean();
  const Eigen::MatrixXd axes = eigenvectors_of(centred * centred.transpose());
  Support support(body, sample.ball.center, options.lp);
  std::vector<Eigen::VectorXd> points;
  double squares = 0;
  std::vector<double> widths;
  Random random = random_of(options.seed, ChainKind::kWidth, 0);
  for (int i = 0; i < n + options.directions; ++i) {
    Eigen::VectorXd direction(n);
    if (i < n) {
      direction = axes.col(n - 1 - i);
    } else {
      for (double& component : direction) component = random.normal();
      direction.normalize();
    }
    double width = 0;
    for (const double sign : {1.0, -1.0}) {
      const std::optional<Eigen::VectorXd> point = support.farthest(sign * direction);
      width += point ? sign * direction.dot(*point) : kNaN;
      if (point) points.push_back(*point);
      if (!point) ++shape.unsolved;
    }
    if (i < n) {
      squares += width * width;
    } else {
      widths.push_back(width);
    }
    if (options.progress && !options.progress({"widths", i + 1, n + options.directions, {}}))
      throw Interrupted();
  }
  // The mean over the widths that were found would be one over directions that are not equally likely.
  const bool all = std::none_of(widths.begin(), widths.end(), [](double width) { return std::isnan(width); });
  const Estimate mean = all ? mean_of(widths) : Estimate{};
  shape.mean_width = unit * mean.value;
  shape.mean_width_error = unit * mean.error;
  Eigen::MatrixXd columns(n, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) columns.col(static_cast<Eigen::Index>(i)) = points[i];
  shape.diameter_lower = unit * large_distance(columns);
  shape.diameter_upper = unit * std::sqrt(squares);
  shape.diameter_by_ranges = kNaN;
  if (ranges != nullptr) {
    if (ranges->states.rows() > 0) {
      const WeightStates states = body.units.weights(SceneStates(ranges->states.transpose()));
      shape.diameter_lower = std::max(shape.diameter_lower, large_distance(states.value()));
    }
    shape.diameter_by_ranges = range_diagonal(*ranges);
    shape.diameter_upper = std::fmin(shape.diameter_upper, shape.diameter_by_ranges);
  }
  return shape;
}

}  // namespace indet
