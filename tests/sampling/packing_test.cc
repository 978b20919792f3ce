#include <gtest/gtest.h>

#include <cmath>

#include "libindet/base/error.h"
#include "libindet/equilibrium/contact_state.h"
#include "libindet/range/analyze.h"
#include "libindet/sampling/shape.h"
#include "libindet/sampling/uniform_sampling.h"
#include "tests/support/zoo.h"

namespace indet {
namespace {

UniformSample draw_on_threads(const ConvexBody& body, int threads = 1, std::uint64_t seed = 0) {
  UniformOptions options;
  options.threads = threads;
  options.seed = seed;
  return sample_uniformly(body, options);
}

/// F is a segment: with u uniform in [0, 1], R = R_min + u δR and T = T_min + u δT.
TEST(Wedge, IsAUniformSegment) {
  const double phi = 0.5, mu = 0.3;
  const zoo::WedgeRanges exact = zoo::wedge_ranges(phi, mu);
  const ConvexBody body = make_body(find_force_polytope(zoo::wedge(phi, mu)));
  ASSERT_EQ(body.dim(), 1);
  const UniformSample sample = draw_on_threads(body);
  ASSERT_TRUE(sample.converged);
  const double error = 4 / std::sqrt(12 * sample.bulk);
  EXPECT_NEAR((sample.center.value()[0] - exact.R_min) / exact.delta_R, 0.5, error);
  EXPECT_NEAR((sample.center.value()[1] - exact.T_min) / exact.delta_T, 0.5, error);
  EXPECT_NEAR(sample.center.value()[2], sample.center.value()[0], 1e-12);
  EXPECT_NEAR(sample.center.value()[3], -sample.center.value()[1], 1e-12);
  // The segment has the length (2 δR² + 2 δT²)^½ in the space of forces, and r = length/√12.
  const double length = std::sqrt(2 * (exact.delta_R * exact.delta_R + exact.delta_T * exact.delta_T));
  EXPECT_NEAR(sample.r.value(), length / std::sqrt(12.0), 4 * sample.r_error.value());
  EXPECT_LT(sample.r_error.value(), 0.05 * sample.r.value());
  EXPECT_NEAR(sample.ball.radius, length / 2, 1e-9);
}

/// Of the segment, every R and T is linear in one uniform number: all correlations are ±1.
TEST(Wedge, HasTheCovarianceOfASegment) {
  const ConvexBody body = make_body(find_force_polytope(zoo::wedge(0.5, 0.3)));
  const UniformSample sample = draw_on_threads(body);
  const Eigen::MatrixXd covariance = body.frame * sample.covariance * body.frame.transpose();
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(std::sqrt(covariance(i, i)), sample.deviation.value()[i], 1e-12);
    for (int k = 0; k < 4; ++k)
      EXPECT_NEAR(std::abs(covariance(i, k)), sample.deviation.value()[i] * sample.deviation.value()[k],
                  1e-12);
  }
  EXPECT_LT(covariance(1, 3), 0);
}

TEST(TwoWedges, AreIndependent) {
  const ConvexBody body = make_body(find_force_polytope(zoo::two_wedges(0.4, 0.3, 0.7, 0.2)));
  ASSERT_EQ(body.blocks.size(), 2U);
  const UniformSample sample = draw_on_threads(body);
  const Eigen::VectorXd left = component_of(body, sample, 0).value();
  const Eigen::VectorXd right = component_of(body, sample, 4).value();
  const double correlation = ((left.array() - left.mean()) * (right.array() - right.mean())).mean() /
                             (sample.deviation.value()[0] * sample.deviation.value()[4]);
  EXPECT_LT(std::abs(correlation), 4 / std::sqrt(sample.bulk));
}

/// Whatever contact is closed everywhere in F (here: all transmit through the wall with μ = 1 slides), the
/// frame is isometric, and samples balance the load.
TEST(Frame, IsIsometricAndKeepsBalance) {
  for (const Packing& packing : {zoo::corner(0.5, 1), zoo::wedge_and_corner(0.4, 0.3),
                                 zoo::column(8, 0.3, 0.4), zoo::two_wedges(0.4, 0.3, 0.7, 0.2)}) {
    const ForcePolytope polytope = find_force_polytope(packing);
    ASSERT_EQ(polytope.status, PolytopeStatus::kBounded);
    const ConvexBody body = make_body(polytope);
    EXPECT_EQ(body.dim(), polytope.dim);
    const Eigen::MatrixXd gram = body.frame.transpose() * body.frame;
    EXPECT_LT((gram - Eigen::MatrixXd::Identity(body.dim(), body.dim())).norm(), 1e-12);
    const UniformSample sample = draw_on_threads(body);
    EXPECT_TRUE(sample.converged);
    for (Eigen::Index i = 0; i < sample.z.cols(); i += 97) {
      const SceneForces F = body.units.scene(InternalForces(body.states(sample.z.col(i)).value()));
      EXPECT_LT(equilibrium_residual(packing, F).cwiseAbs().maxCoeff(), 1e-11);
      EXPECT_EQ(count_coulomb(packing, F, 1e-11).violated, 0);
    }
  }
}

/// The same sample in mg and in the scene's unit, whatever unit of force the scene names: named ones far from
/// the weights are not those in which the equilibrium problem is posed.
TEST(Samples, DoNotDependOnTheUnitOfForceThatTheSceneNames) {
  Packing packing = zoo::column(6, 0.3, 0.4);
  const ForceRanges ranges = analyze(packing);
  const double mg = packing.force_unit();
  const UniformSample expected = draw_on_threads(make_body(find_force_polytope(packing)));
  for (const double named : {1e-6, 1e-3, 1.0, 30000.0, 1e6}) {
    SCOPED_TRACE(named);
    packing.named_force_unit = named * mg;
    const ConvexBody body = make_body(find_force_polytope(packing));
    const UniformSample sample = draw_on_threads(body);
    const Eigen::VectorXd center = body.units.scene(sample.center).value();
    for (Eigen::Index k = 0; k < center.size(); ++k) {
      const int column = k % 2 == 0 ? kMinR : kMinT;
      EXPECT_GE(center[k], ranges.value(k / 2, column) - 1e-9 * mg);
      EXPECT_LE(center[k], ranges.value(k / 2, column + 1) + 1e-9 * mg);
    }
    // Another unit is another rounding of the coordinates, and so another sample of the same distribution.
    const double error = 5 * mg * std::hypot(expected.r_error.value(), expected.r_error.value());
    EXPECT_NEAR(body.units.scene(sample.r).value(), expected.r.value() * mg, error);
    const PolytopeShape shape = measure_shape(body, sample, nullptr);
    EXPECT_NEAR(shape.inscribed_radius * named * mg,
                body.units.scene(InternalForce(sample.ball.radius)).value(), 1e-12 * mg);
  }
}

TEST(Samples, LieInsideTheRangesThatLinearProgramsFind) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const Packing packing = zoo::random_pile(seed, 12, 0.4);
    const ForcePolytope polytope = find_force_polytope(packing);
    if (polytope.status != PolytopeStatus::kBounded) continue;
    const ForceRanges ranges = analyze(packing);
    const ConvexBody body = make_body(polytope);
    const UniformSample sample = draw_on_threads(body, 1, seed);
    EXPECT_TRUE(sample.converged) << seed;
    for (int k = 0; k < body.frame.rows(); ++k) {
      const Eigen::VectorXd values = body.units.scene(component_of(body, sample, k)).value();
      const int column = k % 2 == 0 ? kMinR : kMinT;
      EXPECT_GE(values.minCoeff(), ranges.value(k / 2, column) - 1e-9);
      EXPECT_LE(values.maxCoeff(), ranges.value(k / 2, column + 1) + 1e-9);
    }
  }
}

TEST(Samples, DoNotDependOnTheNumberOfThreads) {
  const ConvexBody body = make_body(find_force_polytope(zoo::column(10, 0.3, 0.4)));
  const UniformSample one = draw_on_threads(body, 1);
  const UniformSample three = draw_on_threads(body, 3);
  EXPECT_EQ(one.z, three.z);
  EXPECT_EQ(one.rhat, three.rhat);
  EXPECT_NE(one.center.value(), draw_on_threads(body, 1, 7).center.value());
}

TEST(Limit, IsReportedAsNotConverged) {
  const ConvexBody body = make_body(find_force_polytope(zoo::column(10, 0.3, 0.4)));
  UniformOptions options;
  options.effective = 100000;
  options.limit = 1000;
  const UniformSample sample = sample_uniformly(body, options);
  EXPECT_FALSE(sample.converged);
  EXPECT_EQ(sample.sweeps, 1000);
  EXPECT_LT(std::min(sample.bulk, sample.tail), 100000);
}

TEST(Options, ThatMakeNoSenseAreRefused) {
  const ConvexBody body = make_body(find_force_polytope(zoo::wedge(0.4, 0.3)));
  UniformOptions options;
  options.chains = 1;
  EXPECT_THROW(sample_uniformly(body, options), InputError);
  options = {};
  options.effective = 10;
  EXPECT_THROW(sample_uniformly(body, options), InputError);
  options = {};
  options.limit = 10;
  EXPECT_THROW(sample_uniformly(body, options), InputError);
}

}  // namespace
}  // namespace indet
