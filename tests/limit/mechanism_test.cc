#include "libindet/limit/mechanism.h"

#include <gtest/gtest.h>

#include "libindet/equilibrium/equilibrium_problem.h"
#include "libindet/limit/load_limits.h"
#include "tests/support/body_variants.h"
#include "tests/support/periodic_lattice.h"
#include "tests/support/zoo.h"

namespace indet {
namespace {

/// Rates are the power of unit forces along the motion: Aᵀ y.
void expect_rates_are_powers(const Packing& packing, const exact::BodyMotion& motion) {
  const EquilibriumProblem problem = pose_equilibrium(packing);
  Eigen::VectorXd y(problem.equations());
  for (int i = 0; i < problem.equations(); ++i) {
    const EquilibriumRow& row = problem.rows[static_cast<std::size_t>(i)];
    if (row.body.is_cell())
      y[i] = row.component == 0   ? motion.cell(0, 0)
             : row.component == 1 ? motion.cell(1, 1)
                                  : motion.cell(0, 1);
    else if (row.body.is_wall())
      y[i] = motion.walls(row.body.wall_id().value(), row.component);
    else
      y[i] = motion.disks(row.body.disk_id().value(), row.component);
  }
  const std::vector<ContactRates> rates = contact_rates(packing, motion);
  const Eigen::VectorXd powers = problem.edge_matrix.transpose() * y;
  for (int k = 0; k < problem.unknowns(); ++k) {
    const Edge& edge = problem.edge(k);
    const ContactRates& rate = rates[static_cast<std::size_t>(edge.contact.value())];
    EXPECT_NEAR(powers[k], edge.R * rate.opening + edge.T * rate.sliding, 1e-14);
  }
}

TEST(Mechanism, RatesArePowersOfUnitForces) {
  int reached = 0;
  for (const std::uint64_t seed : {1, 2, 3}) {
    Packing packing = zoo::with_levers(zoo::with_loaded_walls(zoo::random_pile(seed, 5, 0.6), seed), seed);
    Loads change;
    change.gravity = {1, 0.2};
    const LoadLimits limits = find_load_limits(packing, change);
    for (const LimitEnd* end : {&limits.smallest, &limits.largest}) {
      if (end->outcome != LimitOutcome::kReached) continue;
      expect_rates_are_powers(packing, end->motion);
      ++reached;
    }
  }
  EXPECT_GE(reached, 2);
  Packing lattice = zoo::periodic_lattice(3, 4, 0.2, 0.05);
  Loads shear;
  shear.stress[2] = 1;
  const LoadLimits limits = find_load_limits(lattice, shear);
  ASSERT_EQ(limits.largest.outcome, LimitOutcome::kReached);
  expect_rates_are_powers(lattice, limits.largest.motion);
}

TEST(Mechanism, NoContactResistsAndThoseWithForceRestOrSlide) {
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    const Packing packing = zoo::random_pile(seed, 6, 0.6);
    Loads change;
    change.gravity = {1, 0};
    const LoadLimits limits = find_load_limits(packing, change);
    const LimitEnd& end = limits.largest;
    ASSERT_EQ(end.outcome, LimitOutcome::kReached) << seed;
    // The change of the load does work, and all of the load none there.
    EXPECT_GT(load_power(packing, change, end.motion), 0);
    Loads there = loads_of(packing);
    there.gravity += end.value * change.gravity;
    EXPECT_NEAR(load_power(packing, there, end.motion), 0, 1e-12);
    const auto rates = contact_rates(packing, end.motion);
    const auto motions = contact_motions(packing, end.motion);
    for (std::size_t i = 0; i < rates.size(); ++i) {
      const double mu = packing.contacts[i].mu;
      EXPECT_GE(rates[i].opening - mu * std::abs(rates[i].sliding), -1e-12);
      const double R = end.forces.value()[2 * static_cast<Eigen::Index>(i)];
      if (R > 1e-9) {
        EXPECT_NE(motions[i], ContactMotion::kOpens) << seed;
      }
    }
  }
}

}  // namespace
}  // namespace indet
