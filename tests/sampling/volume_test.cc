#include "libindet/sampling/volume.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "libindet/range/analyze.h"
#include "libindet/sampling/placement.h"
#include "libindet/sampling/shape.h"
#include "tests/sampling/bodies.h"
#include "tests/support/zoo.h"

namespace indet {
namespace {

using test::box;
using test::simplex;

UniformSample draw_for_volume(const ConvexBody& body, double effective = 400) {
  UniformOptions options;
  options.effective = effective;
  return sample_uniformly(body, options);
}

VolumeEstimate volume_of(const SlopeView& view, int sweeps, int threads = 1) {
  const ConvexBody body = make_body(view);
  VolumeOptions options;
  options.sweeps = sweeps;
  options.threads = threads;
  return estimate_volume(body, draw_for_volume(body), options);
}

void expect_volume(const SlopeView& view, double log_volume, int sweeps, double largest_error) {
  const VolumeEstimate estimate = volume_of(view, sweeps);
  EXPECT_NEAR(estimate.log_volume, log_volume, 4 * estimate.error);
  EXPECT_LT(estimate.error, largest_error);
  EXPECT_GT(estimate.error, 0);
}

double log_simplex(int n) { return -std::lgamma(n + 1); }

TEST(Volume, OfSimplexAndCubeInDimension5) {
  expect_volume(simplex(5), log_simplex(5), 300, 0.1);
  expect_volume(box(Eigen::VectorXd::Constant(5, 3)), 5 * std::log(3), 300, 0.1);
}

TEST(Volume, OfSimplexAndCubeInDimension20) {
  expect_volume(simplex(20), log_simplex(20), 300, 0.2);
  expect_volume(box(Eigen::VectorXd::Constant(20, 0.5)), 20 * std::log(0.5), 300, 0.2);
}

TEST(Volume, OfSimplexAndCubeInDimension40) {
  expect_volume(simplex(40), log_simplex(40), 500, 0.2);
  expect_volume(box(Eigen::VectorXd::Constant(40, 2)), 40 * std::log(2), 500, 0.2);
}

TEST(Volume, OfAThinShearedBoxIsThatOfTheBox) {
  const int n = 6;
  Eigen::VectorXd widths(n);
  widths << 1e-4, 1, 20, 3e-2, 5, 400;
  Eigen::MatrixXd map = Eigen::MatrixXd::Identity(n, n);
  for (int i = 1; i < n; ++i) map(i, i - 1) = 10;
  expect_volume(test::mapped(box(widths), map), widths.array().log().sum(), 300, 0.1);
}

TEST(Volume, DoesNotDependOnTheNumberOfThreads) {
  const VolumeEstimate one = volume_of(simplex(6), 100, 1);
  const VolumeEstimate three = volume_of(simplex(6), 100, 3);
  EXPECT_EQ(one.log_volume, three.log_volume);
  EXPECT_EQ(one.error, three.error);
}

/// The stated error is that of the estimate: over seeds, (estimate − exact)/error has a variance of about 1.
TEST(Volume, HasTheErrorThatItStates) {
  const ConvexBody body = make_body(simplex(4));
  const UniformSample sample = draw_for_volume(body);
  double squares = 0;
  constexpr int kSeeds = 40;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    VolumeOptions options;
    options.sweeps = 50;
    options.seed = seed;
    const VolumeEstimate estimate = estimate_volume(body, sample, options);
    squares += std::pow((estimate.log_volume - log_simplex(4)) / estimate.error, 2);
  }
  // χ² with 40 degrees of freedom, and Student's tails of 15: 0.45 … 2.1 leaves out one in 10⁴.
  EXPECT_GT(squares / kSeeds, 0.45);
  EXPECT_LT(squares / kSeeds, 2.1);
}

/// The two contacts of a wedge: a segment of length ℓ = (2 δR² + 2 δT²)^½.
TEST(Shape, OfAWedgeIsThatOfASegment) {
  const Packing packing = zoo::wedge(0.5, 0.3);
  const zoo::WedgeRanges exact = zoo::wedge_ranges(0.5, 0.3);
  const double length = std::sqrt(2 * (exact.delta_R * exact.delta_R + exact.delta_T * exact.delta_T));
  const ConvexBody body = make_body(find_force_polytope(packing));
  const ForceRanges ranges = analyze(packing);
  const UniformSample sample = draw_for_volume(body);
  const PolytopeShape shape = measure_shape(body, sample, &ranges);
  EXPECT_NEAR(shape.diameter_lower, length, 1e-9);
  EXPECT_NEAR(shape.diameter_upper, length, 1e-9);
  EXPECT_NEAR(shape.diameter_by_ranges, length, 1e-9);
  EXPECT_NEAR(shape.mean_width, length, 1e-9);
  EXPECT_NEAR(shape.inscribed_radius, length / 2, 1e-9);
  const VolumeEstimate volume = estimate_volume(body, sample, {});
  EXPECT_NEAR(volume.log_volume, std::log(length), 4 * volume.error);
}

/// [0, 1]ⁿ: the diameter is √n, w(u) = Σ|u_i|, whose mean over directions is n Γ(n/2)/(√π Γ((n + 1)/2)).
TEST(Shape, OfACube) {
  const int n = 7;
  const ConvexBody body = make_body(box(Eigen::VectorXd::Ones(n)));
  ShapeOptions options;
  options.directions = 200;
  const PolytopeShape shape = measure_shape(body, draw_for_volume(body), nullptr, options);
  EXPECT_NEAR(shape.inscribed_radius, 0.5, 1e-9);
  EXPECT_LE(shape.diameter_lower, std::sqrt(n) + 1e-9);
  EXPECT_GT(shape.diameter_lower, 0.8 * std::sqrt(n));
  EXPECT_GE(shape.diameter_upper, std::sqrt(n) - 1e-9);
  const double mean_width =
      n * std::tgamma(n / 2.0) / (std::sqrt(std::numbers::pi) * std::tgamma((n + 1) / 2.0));
  EXPECT_NEAR(shape.mean_width, mean_width, 4 * shape.mean_width_error);
  EXPECT_LT(shape.mean_width_error, 0.03 * mean_width);
}

TEST(Shape, OfAPackingIsBoundedFromBothSides) {
  const Packing packing = zoo::column(8, 0.3, 0.4);
  const ConvexBody body = make_body(find_force_polytope(packing));
  const UniformSample sample = draw_for_volume(body);
  const ForceRanges ranges = analyze(packing);
  const PolytopeShape shape = measure_shape(body, sample, &ranges);
  EXPECT_LE(shape.diameter_lower, shape.diameter_upper);
  EXPECT_LE(shape.diameter_upper, shape.diameter_by_ranges);
  EXPECT_LE(2 * shape.inscribed_radius, shape.mean_width);
  EXPECT_LE(shape.mean_width, shape.diameter_upper);
  EXPECT_LE(2 * sample.r.value(), shape.diameter_upper * std::sqrt(2));
}

/// With too few pivots allowed linear programs are not solved, and nothing takes the place of what needs
/// them.
TEST(Shape, WithoutTheSolutionsOfLinearProgramsHasNoMeanWidth) {
  const ConvexBody body = make_body(find_force_polytope(zoo::column(8, 0.3, 0.4)));
  const UniformSample sample = draw_for_volume(body);
  const PolytopeShape whole = measure_shape(body, sample, nullptr);
  EXPECT_EQ(whole.unsolved, 0);
  ShapeOptions options;
  options.lp.iteration_limit = 2;
  const PolytopeShape part = measure_shape(body, sample, nullptr, options);
  EXPECT_GT(part.unsolved, 0);
  EXPECT_TRUE(std::isnan(part.mean_width));
  EXPECT_TRUE(std::isnan(part.diameter_upper));
  EXPECT_GT(part.diameter_lower, 0);
  EXPECT_LE(part.diameter_lower, whole.diameter_lower + 1e-9);
}

TEST(Placement, OfASampleIsSomewhereInTheMiddleAndOfAnExtremalStateAtTheEnd) {
  const Packing packing = zoo::column(8, 0.3, 0.4);
  const ConvexBody body = make_body(find_force_polytope(packing));
  const UniformSample sample = draw_for_volume(body);
  const ForceRanges ranges = analyze(packing);

  // Over many samples the percentiles of a sample are uniform: their mean is 50 ± 29/√n.
  double norm = 0, distance = 0, inside = 0, place = 0;
  constexpr int kStates = 50;
  for (int i = 0; i < kStates; ++i) {
    const InternalForces F(body.states(sample.z.col(i * sample.count() / kStates)).value());
    const Placement p = place_state(packing, body, sample, body.units.scene(F), &ranges);
    norm += p.norm_percentile / kStates;
    distance += p.distance_percentile / kStates;
    inside += p.central_fraction_R / kStates;
    EXPECT_EQ(p.sliding, 0);
    EXPECT_EQ(p.sliding_percentile, 50);  // as all samples
    place += p.percentile_R[3] / kStates;
    EXPECT_GT(p.mean_R_star, 0);
    EXPECT_LT(p.mean_R_star, 1);
  }
  EXPECT_NEAR(norm, 50, 4 * 29 / std::sqrt(kStates));
  EXPECT_NEAR(distance, 50, 4 * 29 / std::sqrt(kStates));
  EXPECT_NEAR(inside, 0.9, 0.1);
  EXPECT_NEAR(place, 50, 4 * 29 / std::sqrt(kStates));

  const ForcePolytope polytope = find_force_polytope(packing);
  const InternalForces lightest = polytope.problem.state(polytope.lightest);
  const Placement end = place_state(packing, body, sample, body.units.scene(lightest), &ranges);
  EXPECT_EQ(end.normal_force_percentile, 0);
  EXPECT_GE(end.sliding, 1);
  EXPECT_EQ(end.sliding_percentile, 100);
}

}  // namespace
}  // namespace indet
