#include "libindet/sampling/bias.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "libindet/range/analyze.h"
#include "tests/sampling/bodies.h"
#include "tests/support/zoo.h"

namespace indet {
namespace {

UniformSample draw_with_seed(const ConvexBody& body, std::uint64_t seed) {
  UniformOptions options;
  options.seed = seed;
  return sample_uniformly(body, options);
}

/// States of another uniform sample, in the order in which they were drawn.
WeightStates states_of(const ConvexBody& body, const UniformSample& sample) {
  return body.units.weights(body.states(sample.z));
}

/// [0, 1]^2n as a body whose even components play the normal forces.
ConvexBody cube(int contacts) { return make_body(test::box(Eigen::VectorXd::Ones(2 * contacts))); }

TEST(Bias, OfAnotherUniformSampleIsNone) {
  const ConvexBody body = cube(6);
  const UniformSample sample = draw_with_seed(body, 0);
  int means = 0;
  int tested = 0;
  double shift = 0;
  double noise = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const SamplingBias bias =
        compare_with_uniform(body, sample, states_of(body, draw_with_seed(body, seed)), nullptr);
    EXPECT_NEAR(bias.r, sample.r.value(), 5 * std::hypot(bias.r_error, sample.r_error.value()));
    EXPECT_NEAR(bias.ratio, 1, 5 * bias.ratio_error);
    shift += bias.center_shift * bias.center_shift / 20;
    noise += bias.center_noise * bias.center_noise / 20;
    tested += bias.tested;
    means += bias.means;
    EXPECT_EQ(bias.control_distributions, 0);
  }
  EXPECT_EQ(tested, 120);
  EXPECT_LE(means, 3);  // at most 5 % of all rounds have one
  // The square of the distance is that of the noise in the mean; what is left of it is about its scatter.
  EXPECT_LT(shift, noise);
}

/// In [0, 1]^2n, a chain of independent states with u_0 replaced by (1 + u_0)/2 has the mean 3/4 and the
/// variance 1/48 there: the centre is shifted by 1/4, and r² = (2n − 1)/12 + 1/48.
TEST(Bias, OfAChainInTheUpperHalfOfOneCoordinate) {
  const int contacts = 4;
  const ConvexBody body = cube(contacts);
  const UniformSample sample = draw_with_seed(body, 0);
  Random random(7, 0);
  Eigen::MatrixXd chain(2 * contacts, 600);
  for (double& x : chain.reshaped()) x = random.uniform();
  chain.row(0) = (chain.row(0).array() + 1) / 2;
  const SamplingBias bias = compare_with_uniform(body, sample, WeightStates(chain), nullptr);
  EXPECT_EQ(bias.states, 600);
  EXPECT_NEAR(bias.center_shift, 0.25, 4 * bias.center_shift_error);
  EXPECT_LT(bias.center_shift_error, 0.02);
  EXPECT_NEAR(bias.r, std::sqrt(7.0 / 12 + 1.0 / 48), 4 * bias.r_error);
  EXPECT_NEAR(bias.ratio, std::sqrt((7 + 0.25) / 8), 4 * bias.ratio_error);
  EXPECT_NEAR(bias.mean[0], 0.75, 4 / std::sqrt(48 * bias.effective[0]));
  EXPECT_NEAR(bias.deviation[1], 1 / std::sqrt(12), 0.05);
  EXPECT_EQ(bias.tested, contacts);
  EXPECT_GE(bias.means, 1);
  EXPECT_LT(bias.tests[0].p_mean, 1e-12);
  EXPECT_LT(bias.tests[0].p_distribution, 1e-12);
  EXPECT_NEAR(bias.tests[0].distance, 0.5, 0.05);
  EXPECT_GT(bias.tests[1].p_mean, 1e-3);
  EXPECT_EQ(bias.control_means, 0);
}

/// A force that is the same in all states has no noise, though its mean is rounded.
TEST(Bias, ForcesThatDoNotVaryHaveNoNoise) {
  const ConvexBody body = cube(1);
  const UniformSample sample = draw_with_seed(body, 0);
  Eigen::MatrixXd chain = Eigen::MatrixXd::Constant(2, 601, 0.5);
  const double noise = compare_with_uniform(body, sample, WeightStates(chain), nullptr).center_noise;
  EXPECT_GT(noise, 0);  // that of the uniform sample
  for (int k = 1; k < 100; ++k) {
    chain.row(0).setConstant(0.01 * k);
    EXPECT_EQ(compare_with_uniform(body, sample, WeightStates(chain), nullptr).center_noise, noise) << k;
  }
}

/// A chain that hardly moves is not worth a test, and says so by its effective size.
TEST(Bias, OfAChainThatCreepsIsNotTested) {
  const ConvexBody body = cube(2);
  const UniformSample sample = draw_with_seed(body, 0);
  Eigen::MatrixXd chain(4, 100);
  for (int i = 0; i < 100; ++i) chain.col(i).setConstant(0.3 + 0.004 * i);
  const SamplingBias bias = compare_with_uniform(body, sample, WeightStates(chain), nullptr);
  EXPECT_LT(bias.effective.maxCoeff(), 10);
  EXPECT_EQ(bias.tested, 0);
  EXPECT_TRUE(std::isnan(bias.tests[0].p_mean));
}

/// The wedge: R is uniform in its range, which is [0, 1] of R*, and standardised in ± √3.
TEST(Bias, HistogramsOfAWedgeAreFlat) {
  const Packing packing = zoo::wedge(0.5, 0.3);
  const ForceRanges ranges = analyze(packing);
  const ConvexBody body = make_body(find_force_polytope(packing));
  const UniformSample sample = draw_with_seed(body, 0);
  const SamplingBias bias =
      compare_with_uniform(body, sample, states_of(body, draw_with_seed(body, 1)), &ranges);
  for (const SampledForces* forces : {&bias.uniform, &bias.chain}) {
    const auto total = [](const BinnedValues& v) {
      return std::accumulate(v.counts.begin(), v.counts.end(), 0);
    };
    EXPECT_EQ(total(forces->force), 2 * (forces == &bias.uniform ? sample.count() : bias.states));
    EXPECT_EQ(total(forces->place), total(forces->force));
    ASSERT_EQ(forces->place.first, 0);
    ASSERT_EQ(forces->place.counts.size(), 20U);
    const double expected = total(forces->place) / 20.0;
    for (const int count : forces->place.counts) EXPECT_NEAR(count, expected, 0.25 * expected);
    // −√3 … √3, in bins of a quarter.
    EXPECT_NEAR(0.25 * forces->standard.first, -std::sqrt(3.0), 0.35);
    EXPECT_NEAR(0.25 * static_cast<double>(forces->standard.counts.size()), 2 * std::sqrt(3.0), 0.6);
  }
}

TEST(BinnedValues, GrowInBothDirections) {
  BinnedValues bins{.width = 0.5};
  for (const double x : {0.6, 2.0, -0.1, 0.9}) bins.add(x);
  EXPECT_EQ(bins.first, -1);
  EXPECT_EQ(bins.counts, (std::vector<std::int32_t>{1, 0, 2, 0, 0, 1}));
}

}  // namespace
}  // namespace indet
