#include "libindet/barrier/dikin_widths.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "libindet/range/analyze.h"
#include "tests/barrier/sets.h"

namespace indet::barrier {
namespace {

using test::packings;
using test::StrengthSet;
using test::vector;

/// σ² = c (X² − X² Aᵀ (A X² Aᵀ)⁻¹ A X²) cᵀ, with dense matrices.
TEST(DikinWidths, FollowTheirDefinition) {
  for (const auto& [name, packing] : packings()) {
    SCOPED_TRACE(name);
    StrengthSet set(packing);
    const AnalyticCentre centre = find_analytic_centre(set.structure, set.cholesky);
    ASSERT_TRUE(centre.found);
    const DikinWidths widths = dikin_widths(set.problem, set.structure, centre, set.cholesky);
    const Eigen::MatrixXd AX = set.matrix() * vector(centre.x).asDiagonal();
    const Eigen::LDLT<Eigen::MatrixXd> factor(AX * AX.transpose());
    const Eigen::MatrixXd C = Eigen::MatrixXd(set.problem.edge_forces) * vector(centre.x).asDiagonal();
    ASSERT_EQ(static_cast<int>(widths.R.size()), packing.contact_count());
    ASSERT_EQ(static_cast<int>(widths.T.size()), packing.contact_count());
    for (int i = 0; i < packing.contact_count(); ++i) {
      for (const int component : {0, 1}) {
        const Eigen::VectorXd c = C.row(2 * i + component).transpose();
        const Eigen::VectorXd Ac = AX * c;
        const double square = c.squaredNorm() - Ac.dot(factor.solve(Ac));
        const double width = (component == 0 ? widths.R : widths.T)[static_cast<std::size_t>(i)];
        EXPECT_GE(width, 0);
        EXPECT_NEAR(width * width, square, 1e-11 * c.squaredNorm()) << i << ", " << component;
      }
    }
  }
}

/// The ellipsoid lies in the set.
TEST(DikinWidths, AreAtMostHalfOfTheRanges) {
  for (const auto& [name, packing] : packings()) {
    SCOPED_TRACE(name);
    StrengthSet set(packing);
    const AnalyticCentre centre = find_analytic_centre(set.structure, set.cholesky);
    const DikinWidths widths = dikin_widths(set.problem, set.structure, centre, set.cholesky);
    const ForceRanges ranges = analyze(packing, options_for(Accuracy::kFast));
    const double unit = set.problem.units.internal_in_scene();
    for (int i = 0; i < packing.contact_count(); ++i) {
      const auto k = static_cast<std::size_t>(i);
      const double R = (ranges.value(i, kMaxR) - ranges.value(i, kMinR)) / unit;
      const double T = (ranges.value(i, kMaxT) - ranges.value(i, kMinT)) / unit;
      const double rounding = 1e-6 * (1 + std::abs(ranges.value(i, kMaxR)) / unit);
      EXPECT_LE(2 * widths.R[k], R + rounding);
      EXPECT_LE(2 * widths.T[k], T + rounding);
      // n slacks: the set lies in the ellipsoid, magnified n times.
      EXPECT_GE(2 * set.structure.columns() * widths.R[k], R - rounding);
      EXPECT_GE(2 * set.structure.columns() * widths.T[k], T - rounding);
    }
  }
}

/// One degree of freedom: with x_k = p_k + q_k t, σ = |q| / √Σ (q_k / x_k)².
TEST(DikinWidths, OfAGrooveHaveAClosedForm) {
  const double phi = 0.5;
  const double mu = 0.4;
  StrengthSet set(zoo::wedge(phi, mu));
  const AnalyticCentre centre = find_analytic_centre(set.structure, set.cholesky);
  const DikinWidths widths = dikin_widths(set.problem, set.structure, centre, set.cholesky);
  const double a = 0.5 / std::cos(phi);
  const double b = std::tan(phi);
  const double T = a * b * mu * mu / (1 - b * b * mu * mu);
  const double R = a + b * T;
  // Of T = t: strengths (R ± T/μ)/2, twice.
  const double plus = (b + 1 / mu) / (R + T / mu);
  const double minus = (b - 1 / mu) / (R - T / mu);
  const double sigma = 1 / std::sqrt(2 * (plus * plus + minus * minus));
  EXPECT_NEAR(widths.T[0], sigma, 1e-5);
  EXPECT_NEAR(widths.T[1], sigma, 1e-5);
  EXPECT_NEAR(widths.R[0], b * sigma, 1e-5);
  EXPECT_NEAR(widths.R[1], b * sigma, 1e-5);
}

}  // namespace
}  // namespace indet::barrier
