#include "libindet/verify/samples_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "apps/bridge/uniform_record.h"
#include "libindet/range/analyze.h"
#include "libindet/sampling/uniform_sampling.h"
#include "libindet/statistics/convergence.h"
#include "libindet/verify/chain_diagnostics.h"
#include "tests/support/zoo.h"
#include "tests/verify/first_message.h"

namespace indet {
namespace {

using testing::Contains;
using testing::HasSubstr;

/// What `indet sample --method uniform --covariance` stores, with all states.
SamplingRecord sampled(const Packing& packing) {
  const ForcePolytope polytope = find_force_polytope(packing);
  const ConvexBody body = make_body(polytope);
  const UniformOptions options;
  const UniformSample sample = sample_uniformly(body, options);
  const double unit = body.units.internal_in_scene();
  SamplingRecord record{"uniform", body.units.scene(sample.center).value(),
                        numbers_of(polytope, sample, options), components_of(body, sample)};
  record.components->states = body.units.scene(some_states(body, sample, sample.count())).value();
  record.components->covariance = unit * unit * body.frame * sample.covariance * body.frame.transpose();
  return record;
}

class SamplesCheck : public testing::Test {
 protected:
  Packing packing_ = zoo::column(3, 0.3, 0.5);
  SamplingRecord good_ = sampled(packing_);

  Verification verify(const SamplingRecord& record) const {
    return verify_samples(packing_, record, "/sampling", nullptr);
  }
  void expect_contradiction(const SamplingRecord& record, const std::string& text) const {
    const Verification found = verify(record);
    EXPECT_GT(found.contradictions, 0) << text;
    EXPECT_THAT(found.messages, Contains(HasSubstr(text)));
  }
};

TEST_F(SamplesCheck, AgreesWithWhatWasDrawn) {
  const Verification found = verify(good_);
  EXPECT_TRUE(found.passed()) << first_message(found);
  EXPECT_EQ(found.states, good_.components->states.cols() + 1);
  EXPECT_LT(found.worst_imbalance, 1e-12);
  EXPECT_TRUE(found.unsolved.empty());
  EXPECT_EQ(found.optima, 0);
  EXPECT_TRUE(std::isnan(found.worst_optimality_gap));
}

TEST_F(SamplesCheck, AgreesWithOldFilesAndWithFilesOfSomeStates) {
  SamplingRecord some = good_;
  for (const char* name : {"norm_rhat", "norm_bulk_ess", "norm_tail_ess"}) some.numbers.erase(name);
  some.components->states = good_.components->states.leftCols(7).eval();
  some.components->covariance.resize(0, 0);
  const Verification found = verify(some);
  EXPECT_TRUE(found.passed()) << first_message(found);
  EXPECT_THAT(found.unchecked, Contains(HasSubstr("7 are stored")));
  some.components->states.resize(Eigen::NoChange, 0);
  EXPECT_TRUE(verify(some).passed()) << first_message(verify(some));
  EXPECT_THAT(verify(some).unchecked, Contains(HasSubstr("none is stored")));
}

TEST_F(SamplesCheck, AnotherUnitOfForceIsAContradictionEvenWithoutStates) {
  SamplingRecord wrong = good_;
  wrong.center *= 30000;
  wrong.components->deviation *= 30000;
  wrong.components->quantiles *= 30000;
  wrong.components->covariance.resize(0, 0);
  wrong.components->states.resize(Eigen::NoChange, 0);
  expect_contradiction(wrong, "center: it violates equilibrium or contact conditions");
}

TEST_F(SamplesCheck, AStateOutsideOfTheConesIsAContradiction) {
  SamplingRecord wrong = good_;
  wrong.components->states.col(3) *= -1;
  expect_contradiction(wrong, "state 3: it violates");
}

TEST_F(SamplesCheck, EachTableIsComparedWithTheStates) {
  const auto with = [&](auto change) {
    SamplingRecord wrong = good_;
    change(*wrong.components);
    return wrong;
  };
  expect_contradiction(with([](ComponentRecord& c) { c.deviation[1] *= 1 + 1e-6; }),
                       "deviation of component 1");
  expect_contradiction(with([](ComponentRecord& c) { c.quantiles(2, 3) += 1e-6; }),
                       "quantile 0.75 of component 2");
  expect_contradiction(with([](ComponentRecord& c) { c.rhat[4] += 1e-6; }), "rhat of component 4");
  expect_contradiction(with([](ComponentRecord& c) { c.bulk[0] += 1e-3; }), "bulk_ess of component 0");
  expect_contradiction(with([](ComponentRecord& c) { c.tail[5] += 1e-3; }), "tail_ess of component 5");
  expect_contradiction(with([](ComponentRecord& c) { c.covariance(0, 1) *= 1 + 1e-6; }), "covariance");
}

TEST_F(SamplesCheck, NotConvergedIsSaid) {
  SamplingRecord record = good_;
  record.numbers["requested"] = 1e6;
  expect_contradiction(record, "converged: 1 is stored");
  record.numbers["converged"] = 0;
  const Verification found = verify(record);
  EXPECT_TRUE(found.passed()) << first_message(found);
  EXPECT_THAT(found.unsolved, Contains(HasSubstr("not converged")));
}

TEST_F(SamplesCheck, TheRangesOfTheSameFileBoundIt) {
  ForceRanges ranges = analyze(packing_);
  EXPECT_TRUE(verify_samples(packing_, good_, "/uniform", &ranges).passed());
  ranges.value(2, kMaxR) = 0.5 * good_.center[4];
  const Verification found = verify_samples(packing_, good_, "/uniform", &ranges);
  EXPECT_THAT(found.messages, Contains(HasSubstr("center: component 4")));
}

TEST(ChainDiagnostics, AreThoseOfTheSampling) {
  // Three chains of 101 numbers that remember where they were, one of them a little aside.
  std::uint64_t state = 1;
  const auto random = [&state] {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<double>(state >> 11) / 9007199254740992.0 - 0.5;
  };
  Eigen::MatrixXd draws(101, 3);
  for (Eigen::Index c = 0; c < 3; ++c) {
    double x = 0;
    for (Eigen::Index i = 0; i < 101; ++i) draws(i, c) = (x = 0.7 * x + random()) + (c == 2 ? 0.3 : 0);
  }
  const ChainAssessor assessor(3, 101);
  const std::span<const double> values(draws.data(), static_cast<std::size_t>(draws.size()));
  const Convergence expected = assessor.assess(values);
  const ChainDiagnostics found = diagnose_chains(draws);
  EXPECT_NEAR(found.rhat[0], expected.rhat, 1e-3);
  double nearest = 1;
  for (const double rhat : found.rhat) nearest = std::min(nearest, std::abs(rhat - expected.rhat));
  EXPECT_LT(nearest, 1e-12);
  EXPECT_NEAR(found.bulk, expected.bulk, 1e-9 * expected.bulk);
  EXPECT_NEAR(found.tail, expected.tail, 1e-9 * expected.tail);
  EXPECT_NEAR(effective_size_of_mean(draws), assessor.effective_size(values), 1e-9 * expected.bulk);
}

}  // namespace
}  // namespace indet
