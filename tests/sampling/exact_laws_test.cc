#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "libindet/sampling/uniform_sampling.h"
#include "tests/sampling/bodies.h"

namespace indet {
namespace {

using test::box;
using test::cut_cone;
using test::simplex;

UniformSample draw_effective(const ConvexBody& body, std::uint64_t seed = 0, double effective = 400) {
  UniformOptions options;
  options.seed = seed;
  options.effective = effective;
  const UniformSample sample = sample_uniformly(body, options);
  EXPECT_TRUE(sample.converged);
  EXPECT_GE(sample.worst_slack, -1e-12);
  return sample;
}

struct Mean {
  double value, error;
};

/// Mean of a function of the samples, with the error that its effective size gives.
Mean mean_of(const UniformSample& sample, const std::function<double(const Eigen::VectorXd&)>& function) {
  std::vector<double> values;
  for (Eigen::Index i = 0; i < sample.z.cols(); ++i) values.push_back(function(sample.z.col(i)));
  const Eigen::Map<const Eigen::ArrayXd> v(values.data(), sample.z.cols());
  const double effective = ChainAssessor(sample.chains, sample.length).effective_size(values);
  return {v.mean(), std::sqrt((v - v.mean()).square().mean() / effective)};
}

void expect_mean(const UniformSample& sample, double expected,
                 const std::function<double(const Eigen::VectorXd&)>& function) {
  const Mean mean = mean_of(sample, function);
  EXPECT_NEAR(mean.value, expected, 4 * mean.error);
  EXPECT_LT(mean.error, 0.05);
}

TEST(Box, HasTheMomentsOfIndependentUniformNumbersThoughItsSidesDifferByAMillion) {
  Eigen::VectorXd widths(6);
  widths << 1, 1e-3, 1e3, 2, 1e-2, 7;
  const UniformSample sample = draw_effective(make_body(box(widths)));
  for (Eigen::Index i = 0; i < widths.size(); ++i) {
    expect_mean(sample, 0.5, [&](const auto& z) { return z[i] / widths[i]; });
    expect_mean(sample, 1.0 / 3, [&](const auto& z) { return std::pow(z[i] / widths[i], 2); });
    expect_mean(sample, 0.25,
                [&](const auto& z) { return z[i] / widths[i] * z[(i + 1) % 6] / widths[(i + 1) % 6]; });
  }
}

TEST(Simplex, HasTheMomentsOfTheDirichletDistribution) {
  for (const int n : {2, 10, 30}) {
    const UniformSample sample = draw_effective(make_body(simplex(n)));
    for (int i = 0; i < n; i += std::max(1, n / 5)) {
      expect_mean(sample, 1.0 / (n + 1), [&](const auto& z) { return z[i]; });
      expect_mean(sample, 2.0 / ((n + 1) * (n + 2)), [&](const auto& z) { return z[i] * z[i]; });
    }
    expect_mean(sample, 1.0 / ((n + 1) * (n + 2)), [&](const auto& z) { return z[0] * z[1]; });
    expect_mean(sample, n / (n + 1.0), [&](const auto& z) { return z.sum(); });
  }
}

TEST(CutCone, HasItsMomentsAlsoWhenItIsSheared) {
  const int n = 8;
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Identity(n, n);
  for (int i = 1; i < n; ++i) inverse(i, i - 1) = 30;
  for (const Eigen::MatrixXd& map : {Eigen::MatrixXd(Eigen::MatrixXd::Identity(n, n)), inverse}) {
    const UniformSample sample = draw_effective(make_body(test::mapped(cut_cone(n), map)));
    expect_mean(sample, n / (n + 1.0), [&](const auto& z) { return map.row(0).dot(z); });
    expect_mean(sample, n / (n + 2.0), [&](const auto& z) { return std::pow(map.row(0).dot(z), 2); });
    // ⟨z_1²⟩ = ⟨z_0²⟩/3.
    expect_mean(sample, n / (n + 2.0) / 3, [&](const auto& z) { return std::pow(map.row(1).dot(z), 2); });
    expect_mean(sample, 0, [&](const auto& z) { return map.row(n - 1).dot(z); });
  }
}

/// sup |F_empirical − F| of independent values: √n times this has the distribution of Kolmogorov.
double kolmogorov_p_value(std::vector<double> values, const std::function<double(double)>& distribution) {
  std::sort(values.begin(), values.end());
  const auto n = static_cast<double>(values.size());
  double distance = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double expected = distribution(values[i]);
    const auto k = static_cast<double>(i);
    distance = std::max({distance, expected - k / n, (k + 1) / n - expected});
  }
  const double x = (std::sqrt(n) + 0.12 + 0.11 / std::sqrt(n)) * distance;
  double p = 0;
  for (int k = 1; k < 100; ++k) p += 2 * (k % 2 == 1 ? 1 : -1) * std::exp(-2.0 * k * k * x * x);
  return std::clamp(p, 0.0, 1.0);
}

TEST(KolmogorovPValue, OfSomeKnownDistances) {
  std::vector<double> even;
  for (int i = 0; i < 1000; ++i) even.push_back((i + 0.5) / 1000);
  EXPECT_GT(kolmogorov_p_value(even, [](double x) { return x; }), 0.999);
  EXPECT_LT(kolmogorov_p_value(even, [](double x) { return x * x; }), 1e-6);
}

/// One p-value for each of 20 seeds, from samples so far apart that they are independent; the p-values are
/// then uniform themselves.
void expect_uniform_p_values(const SlopeView& view, int component,
                             const std::function<double(double)>& distribution) {
  std::vector<double> p_values;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const UniformSample sample = draw_effective(make_body(view), seed, 1000);
    const auto between =
        static_cast<Eigen::Index>(std::ceil(4.0 * sample.count() / std::min(sample.bulk, sample.tail)));
    std::vector<double> values;
    for (Eigen::Index i = 0; i < sample.z.cols(); i += between) values.push_back(sample.z(component, i));
    EXPECT_GT(values.size(), 100U);
    p_values.push_back(kolmogorov_p_value(values, distribution));
  }
  EXPECT_GT(*std::min_element(p_values.begin(), p_values.end()), 1e-4);
  EXPECT_GT(kolmogorov_p_value(p_values, [](double x) { return x; }), 1e-3);
}

TEST(KolmogorovSmirnov, MarginalsOfASimplexOver20Seeds) {
  expect_uniform_p_values(simplex(5), 2, [](double x) { return 1 - std::pow(1 - x, 5); });
}

TEST(KolmogorovSmirnov, MarginalsOfABoxOver20Seeds) {
  expect_uniform_p_values(box(Eigen::VectorXd::Constant(4, 2.0)), 1, [](double x) { return x / 2; });
}

TEST(KolmogorovSmirnov, HeightOfACutConeOver20Seeds) {
  expect_uniform_p_values(cut_cone(4), 0, [](double x) { return std::pow(x, 4); });
}

}  // namespace
}  // namespace indet
