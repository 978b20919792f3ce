#include "libsim/balance_solver.h"

#include <gtest/gtest.h>

#include <Eigen/QR>

#include "libindet/base/random.h"
#include "libsim/polish.h"
#include "libsim/static_solver.h"
#include "tests/sim/worlds.h"

namespace indet::sim {
namespace {

using enum ContactStatus;

Packing settled() {
  Scene scene;
  scene.disks = 25;
  scene.seed = 6;
  const World world = build(scene);
  return simulate(world, {}, contact_dynamics(default_time_limit(world, scene.resolved().height))).packing;
}

std::vector<ContactStatus> statuses_of(const Packing& packing, std::uint64_t seed) {
  Random random(seed);
  std::vector<ContactStatus> statuses;
  for (int i = 0; i < packing.contact_count(); ++i) {
    const double u = random.uniform(0, 1);
    statuses.push_back(u < 0.8 ? kSticking : u < 0.87 ? kSlidingUp : u < 0.94 ? kSlidingDown : kOpen);
  }
  return statuses;
}

/// In the unit of the packing.
Eigen::VectorXd some_forces(const Packing& packing, std::uint64_t seed) {
  Random random(seed);
  Eigen::VectorXd forces = packing.simulated_forces().value() / packing.internal_force_unit();
  for (double& force : forces) force += 0.1 * random.uniform(-1, 1);
  return forces;
}

/// The least change by a dense decomposition of the matrix of all free directions.
Eigen::VectorXd dense_change(const Packing& packing, const std::vector<ContactStatus>& statuses,
                             const Eigen::VectorXd& forces) {
  std::vector<Eigen::VectorXd> directions;  // of forces
  for (int i = 0; i < packing.contact_count(); ++i) {
    const double mu = packing[ContactId(i)].mu;
    const auto free = [&](double R, double T) {
      directions.emplace_back(Eigen::VectorXd::Zero(forces.size()));
      directions.back().segment<2>(2 * i) = Eigen::Vector2d(R, T).normalized();
    };
    if (statuses[i] == kSticking) {
      free(1, 0);
      free(0, 1);
    }
    if (statuses[i] == kSlidingUp) free(1, mu);
    if (statuses[i] == kSlidingDown) free(1, -mu);
  }
  const auto wrenches = [&](const Eigen::VectorXd& f) {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(3 * packing.disk_count());
    for (int i = 0; i < packing.contact_count(); ++i) {
      const Contact& contact = packing[ContactId(i)];
      const Eigen::Vector2d normal(contact.normal.x(), contact.normal.y());
      const Eigen::Vector2d force =
          f[2 * i] * normal + f[2 * i + 1] * Eigen::Vector2d(normal.y(), -normal.x());
      sum.segment<2>(3 * contact.a.value()) += force;
      sum[3 * contact.a.value() + 2] += f[2 * i + 1];
      if (contact.b.is_wall()) continue;
      sum.segment<2>(3 * contact.b.disk_id().value()) -= force;
      sum[3 * contact.b.disk_id().value() + 2] += f[2 * i + 1];
    }
    return sum;
  };
  Eigen::VectorXd imbalance = wrenches(forces);
  for (int i = 0; i < packing.disk_count(); ++i) {
    imbalance.segment<3>(3 * i) += packing.wrench(DiskId(i)) / packing.internal_force_unit();
  }
  Eigen::MatrixXd free(forces.size(), directions.size());
  Eigen::MatrixXd matrix(imbalance.size(), directions.size());
  for (std::size_t k = 0; k < directions.size(); ++k) {
    free.col(static_cast<int>(k)) = directions[k];
    matrix.col(static_cast<int>(k)) = wrenches(directions[k]);
  }
  return -free * matrix.completeOrthogonalDecomposition().solve(imbalance);
}

TEST(BalanceSolver, FindsTheChangeOfLeastNorm) {
  const Packing packing = settled();
  BalanceSolver solver(packing);
  const std::vector<ContactStatus> sticking(static_cast<std::size_t>(packing.contact_count()), kSticking);
  std::vector<ContactStatus> sliding = sticking;
  sliding[5] = kSlidingUp;
  sliding[9] = kSlidingDown;
  std::vector<ContactStatus> open = sliding;  // and no longer in balance
  open[0] = kOpen;
  for (const std::vector<ContactStatus>& statuses : {sticking, sliding, open}) {
    ASSERT_TRUE(solver.factorise(statuses));
    const Eigen::VectorXd start = some_forces(packing, 3);
    const Eigen::VectorXd expected = dense_change(packing, statuses, start);
    EXPECT_NEAR(solver.least_change(start), expected.norm(), 1e-6 * expected.norm());
    Eigen::VectorXd forces = start;
    solver.apply(forces);
    EXPECT_EQ(solver.residual(forces) < 1e-12, statuses != open);
    EXPECT_NEAR(solver.residual(forces), solver.residual(start + expected), 1e-11);
    EXPECT_LT((forces - start - expected).norm(), 1e-9 * expected.norm());
  }
}

TEST(BalanceSolver, ForgetsWhatItSolvedBefore) {
  const Packing packing = settled();
  BalanceSolver reused(packing);
  for (const std::uint64_t seed : {1, 2, 3, 2, 2, 1}) {
    BalanceSolver fresh(packing);
    const std::vector<ContactStatus> statuses = statuses_of(packing, seed);
    ASSERT_EQ(reused.factorise(statuses), fresh.factorise(statuses));
    const Eigen::VectorXd start = some_forces(packing, seed);
    EXPECT_EQ(reused.least_change(start), fresh.least_change(start));
    Eigen::VectorXd one = start;
    Eigen::VectorXd other = start;
    reused.apply(one);
    fresh.apply(other);
    EXPECT_EQ(one, other);
  }
}

TEST(Polisher, GivesWhatAFreshOneGives) {
  const Packing packing = settled();
  Polisher reused(packing);
  for (const std::uint64_t seed : {1, 2, 1, 3}) {
    const Eigen::VectorXd raw = some_forces(packing, seed) * packing.internal_force_unit();
    const Polished expected = polish(packing, raw);
    const double distance = reused.least_distance(raw);
    const Polished result = reused.polish(raw);
    EXPECT_EQ(result.forces, expected.forces);
    EXPECT_EQ(result.residual, expected.residual);
    EXPECT_EQ(result.distance, expected.distance);
    EXPECT_EQ(result.rounds, expected.rounds);
    EXPECT_EQ(result.reason, expected.reason);
    EXPECT_EQ(distance, Polisher(packing).least_distance(raw));
    EXPECT_GT(distance, 0);
    EXPECT_LE(distance, expected.distance * (1 + 1e-9));
  }
}

TEST(Polisher, KnowsThatNothingBalancesAnEmptyPacking) {
  const Packing packing;
  EXPECT_EQ(Polisher(packing).least_distance(Eigen::VectorXd(0)), 0);
  EXPECT_TRUE(polish(packing, Eigen::VectorXd(0)).balanced);
}

TEST(StaticSolver, GivesWhatAFreshOneGives) {
  const Packing packing = settled();
  StaticSolver reused(packing);
  for (const std::uint64_t seed : {1, 2, 1}) {
    const Eigen::VectorXd start = some_forces(packing, seed) * packing.internal_force_unit();
    const StaticOptions options{.max_sweeps = 300};
    EXPECT_EQ(reused.solve(start, options).forces, solve_statics(packing, start, options).forces);
  }
}

}  // namespace
}  // namespace indet::sim
