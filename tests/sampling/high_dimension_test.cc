#include <gtest/gtest.h>

#include <cmath>

#include "bodies.h"
#include "indet/sampling/volume.h"

namespace indet {
namespace {

void expect_volume(const FeasibleSet& set, double log_volume) {
  const ConvexBody body = make_body(set);
  const UniformSample sample = sample_uniformly(body, {});
  EXPECT_TRUE(sample.converged);
  VolumeOptions options;
  options.sweeps = 1000;
  const VolumeEstimate estimate = estimate_volume(body, sample, options);
  EXPECT_NEAR(estimate.log_volume, log_volume, 4 * estimate.error);
  EXPECT_LT(estimate.error, 0.2);
}

TEST(VolumeInDimension40, OfASimplex) { expect_volume(test::simplex(40), -std::lgamma(41)); }

TEST(VolumeInDimension40, OfACube) {
  expect_volume(test::box(Eigen::VectorXd::Constant(40, 2)), 40 * std::log(2));
}

}  // namespace
}  // namespace indet
