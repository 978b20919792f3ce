#include "libindet/barrier/state_pairs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "libindet/base/constants.h"
#include "libindet/base/random.h"
#include "tests/barrier/runs.h"
#include "tests/barrier/sets.h"

namespace indet::barrier {
namespace {

using test::packings;
using test::StrengthSet;
using test::vector;

/// A set with its centre, and the pairs of its states.
struct Pairs {
  explicit Pairs(const Packing& packing)
      : set(packing),
        centre(find_analytic_centre(set.structure, set.cholesky)),
        verified(set.problem, set.structure, centre),
        pairs(set.problem, set.rows, set.structure, centre, verified) {}

  Eigen::VectorXd difference(std::span<const double> both) const {
    const Eigen::VectorXd x = vector(both);
    return set.problem.edge_forces * (x.head(x.size() / 2) - x.tail(x.size() / 2));
  }

  StrengthSet set;
  AnalyticCentre centre;
  VerifiedEquations verified;
  StatePairs pairs;
};

/// R of every third contact, that can vary.
std::vector<Objective> some_forces(const StrengthSet& set) {
  std::vector<Objective> some;
  for (int i = 0; i < static_cast<int>(set.problem.modes.size()); i += 3) {
    Objective c = set.objective(i, kMinR);
    if (!c.empty()) some.push_back(std::move(c));
  }
  return some;
}

struct Found {
  std::vector<double> x, y;
  bool converged = false;
};

std::vector<Found> minimise(const Pairs& p, const std::vector<Objective>& forces, double g,
                            int vector_bits = 512) {
  std::vector<Objective> objectives;
  for (const Objective& c : forces) objectives.push_back(p.pairs.objective(c));
  std::vector<Found> found(forces.size());
  std::size_t next = 0;
  LockStepOptions options;
  options.gap = 1e-8;
  options.least_aim = 0.1;
  options.vector_bits = vector_bits;
  LockStepCalls calls;
  calls.next = [&]() -> std::optional<std::size_t> {
    return next < objectives.size() ? std::optional(next++) : std::nullopt;
  };
  calls.objective = [&](std::size_t k) -> const Objective& { return objectives[k]; };
  calls.finish = [&](const Iterate& iterate) {
    found[iterate.objective] = {
        {iterate.x.begin(), iterate.x.end()}, {iterate.y.begin(), iterate.y.end()}, iterate.converged};
  };
  calls.keep_on = [] { return true; };
  calls.give = [&](std::size_t) { return g; };
  minimise_in_lock_step(p.pairs.structure(), p.pairs.centre(), options, calls);
  return found;
}

/// The conditions of the optimum: A x = b, A x' = b, and z = −B (x − x')/g; that multipliers allow nothing
/// better is what the dual value says.
TEST(StatePairs, AreOptimal) {
  for (const auto& [name, packing] : packings()) {
    SCOPED_TRACE(name);
    const Pairs p(packing);
    ASSERT_TRUE(p.verified.is_proven());
    const Eigen::MatrixXd A = p.set.matrix();
    const std::vector<Objective> forces = some_forces(p.set);
    for (const double g : {10.0, 1e4}) {
      const std::vector<Found> found = minimise(p, forces, g);
      for (std::size_t k = 0; k < found.size(); ++k) {
        const Eigen::VectorXd x = vector(found[k].x), u = p.difference(found[k].x);
        EXPECT_TRUE(found[k].converged);
        EXPECT_GT(x.minCoeff(), 0);
        double linear = 0;
        for (const auto& [column, weight] : p.pairs.objective(forces[k])) linear += weight * x[column];
        const double value = linear + u.squaredNorm() / (2 * g);
        const double size = std::max(1.0, x.maxCoeff());
        for (const int copy : {0, 1}) {
          const auto half = copy == 0 ? x.head(A.cols()) : x.tail(A.cols());
          EXPECT_LE((A * half - A * vector(p.centre.x)).lpNorm<Eigen::Infinity>(), 1e-5 * size);
        }
        const Iterate iterate{k, found[k].x, found[k].y, 0, true};
        const StatePairs::Proof proof = p.pairs.prove(forces[k], g, iterate);
        EXPECT_LE(proof.dual, value + 1e-6 * size);
        EXPECT_GE(proof.dual, value - 1e-6 * std::max(size, std::abs(value)));
        EXPECT_NEAR(proof.distance, u.norm(), 1e-4 * size);
        EXPECT_NEAR(proof.largest - proof.least, -linear, 1e-5 * size);
      }
    }
  }
}

/// The bound from below holds whatever multipliers it is made of: no pair of states is below it.
TEST(StatePairs, BoundFromAnyMultipliers) {
  Random random(7);
  for (const auto& [name, packing] : packings()) {
    SCOPED_TRACE(name);
    const Pairs p(packing);
    const std::vector<Objective> forces = some_forces(p.set);
    const double g = 100;
    const std::vector<Found> found = minimise(p, forces, g);
    for (std::size_t k = 0; k < found.size(); ++k) {
      std::vector<double> y = found[k].y;
      for (double& entry : y) entry += 0.01 * (2 * random.uniform() - 1);
      const double dual = p.pairs.prove(forces[k], g, {k, found[k].x, y, 0, true}).dual;
      for (const Found& other : found) {
        double value = p.difference(other.x).squaredNorm() / (2 * g);
        for (const auto& [column, weight] : p.pairs.objective(forces[k]))
          value += weight * other.x[static_cast<std::size_t>(column)];
        EXPECT_LE(dual, value + 1e-6 * std::max(1.0, std::abs(value)));
      }
    }
  }
}

TEST(StatePairs, AreTheSameBitsWithAnyRegisters) {
  const Pairs p(packings().front().packing);
  const std::vector<Objective> forces = some_forces(p.set);
  const std::vector<Found> wide = minimise(p, forces, 100, 512);
  for (const int bits : {128, 256}) {
    const std::vector<Found> narrow = minimise(p, forces, 100, bits);
    for (std::size_t k = 0; k < wide.size(); ++k) {
      EXPECT_EQ(std::memcmp(wide[k].x.data(), narrow[k].x.data(), wide[k].x.size() * sizeof(double)), 0);
      EXPECT_EQ(std::memcmp(wide[k].y.data(), narrow[k].y.data(), wide[k].y.size() * sizeof(double)), 0);
    }
  }
}

}  // namespace
}  // namespace indet::barrier
