#include "libindet/equilibrium/equilibrium_problem.h"

#include <gtest/gtest.h>

#include <vector>

#include "libindet/base/random.h"
#include "tests/support/body_variants.h"
#include "tests/support/compare.h"
#include "tests/support/oracle.h"
#include "tests/support/zoo.h"

namespace indet {
namespace {

std::vector<Packing> piles() {
  std::vector<Packing> result = {zoo::wedge(0.4, 0.3), zoo::pyramid(0.8, 0.3, 2), zoo::column(4, 0.5, 0.3),
                                 zoo::wedge_and_loose_disk(0.4, 0.3, 0.5), zoo::spun_wedge(0.5, 0, 0.1)};
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    result.push_back(zoo::rescaled(zoo::random_pile(seed, 6, -1), 0.37, 1.9, 9.81));
    result.back().disks[2].load = {0.3, -2, 0.7};
    if (seed % 2 == 1) result.back() = zoo::with_levers(zoo::with_fixed_disks(result.back(), seed), seed);
  }
  return result;
}

/// Rows of the paper's matrix that an equation stands for, torque rows divided by the radius.
Eigen::MatrixXd rows_of(const Packing& packing, const EquilibriumProblem& problem,
                        const Eigen::MatrixXd& paper) {
  Eigen::MatrixXd result(problem.equations(), paper.cols());
  for (int i = 0; i < problem.equations(); ++i) {
    const EquilibriumRow& row = problem.rows[static_cast<std::size_t>(i)];
    result.row(i) = paper.row(3 * row.body.disk_id().value() + row.component);
    if (row.component == 2) result.row(i) /= packing[row.body.disk_id()].radius;
  }
  return result;
}

std::vector<ContactMode> modes_by_chance(const Packing& packing, Random& random) {
  std::vector<ContactMode> modes = natural_modes(packing);
  for (ContactMode& mode : modes) {
    if (mode == ContactMode::kFrictionless) {
      mode = random.below(2) == 0 ? ContactMode::kOpen : mode;
    } else {
      mode = std::vector{ContactMode::kStick, ContactMode::kSlidePlus, ContactMode::kSlideMinus,
                         ContactMode::kOpen}[random.below(4)];
    }
  }
  return modes;
}

/// F = forces · u, 2M × unknowns: R and T themselves where a contact sticks, else those of its edge.
Eigen::MatrixXd forces_of_unknowns(const EquilibriumProblem& problem) {
  Eigen::MatrixXd forces = Eigen::MatrixXd::Zero(2 * std::ssize(problem.contacts), problem.unknowns());
  for (int k = 0; k < problem.unknowns(); ++k) {
    const Edge& edge = problem.edge(k);
    const int row = 2 * edge.contact.value();
    if (problem.is_stick(edge)) {
      forces(row + (edge.sign > 0 ? 0 : 1), k) = 1;
    } else {
      forces(row, k) = edge.R;
      forces(row + 1, k) = edge.T;
    }
  }
  return forces;
}

TEST(EquilibriumProblem, IsThePapersMatrixInEveryMode) {
  Random random(3);
  for (const Packing& packing : piles()) {
    for (int repeat = 0; repeat < 4; ++repeat) {
      const auto modes = repeat == 0 ? natural_modes(packing) : modes_by_chance(packing, random);
      const EquilibriumProblem problem = pose_equilibrium(packing, modes);
      const Eigen::MatrixXd paper = oracle::paper_matrix(packing);
      const Eigen::MatrixXd kept = rows_of(packing, problem, paper);
      EXPECT_TRUE(
          test::same_entries(kept * forces_of_unknowns(problem), Eigen::MatrixXd(problem.matrix), 1e-15));
      EXPECT_TRUE(test::same_entries(kept * Eigen::MatrixXd(problem.edge_forces),
                                     Eigen::MatrixXd(problem.edge_matrix), 1e-15));
      EXPECT_TRUE(test::same_entries(rows_of(packing, problem, -oracle::paper_wrench(packing)),
                                     problem.right_hand_sides, 1e-15));
      // What is left out would read 0 = 0.
      const Eigen::VectorXd generic = Eigen::VectorXd::LinSpaced(problem.unknowns(), 1, 2);
      Eigen::VectorXd balance =
          paper * (forces_of_unknowns(problem) * generic) + oracle::paper_wrench(packing);
      for (const EquilibriumRow& row : problem.rows)
        balance[3 * row.body.disk_id().value() + row.component] = 0;
      EXPECT_EQ(balance.lpNorm<Eigen::Infinity>(), 0);
    }
  }
}

TEST(EquilibriumProblem, EdgesAreTheConesOfTheContacts) {
  Random random(4);
  for (const Packing& packing : piles()) {
    const EquilibriumProblem problem = pose_equilibrium(packing, modes_by_chance(packing, random));
    const Eigen::MatrixXd to_edges = problem.to_edges;
    ASSERT_EQ(static_cast<int>(problem.edges.size()), problem.unknowns());
    // Edge strengths and unknowns describe the same forces, and edges are edges: T = ±μR, R > 0.
    EXPECT_TRUE(test::same_entries(Eigen::MatrixXd(problem.edge_forces) * to_edges,
                                   forces_of_unknowns(problem), 1e-14));
    for (int k = 0; k < problem.unknowns(); ++k) {
      const Edge& edge = problem.edges[static_cast<std::size_t>(k)];
      const double mu = packing[edge.contact].mu;
      EXPECT_GT(edge.R, 0);
      EXPECT_LE(std::max(edge.R, std::abs(edge.T)), 1);
      EXPECT_DOUBLE_EQ(edge.T, edge.sign * mu * edge.R);
      Eigen::VectorXd force = Eigen::VectorXd::Zero(2 * packing.contact_count());
      force[2 * edge.contact.value()] = edge.R;
      force[2 * edge.contact.value() + 1] = edge.T;
      EXPECT_TRUE(
          test::same_entries(problem.edge_forces * Eigen::VectorXd::Unit(problem.unknowns(), k), force, 0));
    }
  }
}

TEST(EquilibriumProblem, HoldsOnlyWhatTheSceneNeeds) {
  const auto sizes = [](const Packing& packing) {
    const EquilibriumProblem problem = pose_equilibrium(packing, natural_modes(packing));
    return std::pair(problem.equations(), problem.unknowns());
  };
  EXPECT_EQ(sizes(zoo::frictionless_column(5, 0.5)), std::pair(10, 10));
  EXPECT_EQ(sizes(zoo::column(5, 0.5, 0.1)), std::pair(15, 20));
  EXPECT_EQ(sizes(zoo::wedge_and_loose_disk(0.4, 0.3, 0)), std::pair(3, 4));
  EXPECT_EQ(sizes(zoo::wedge_and_loose_disk(0.4, 0.3, 1)), std::pair(4, 4));  // pulled along x alone
  EXPECT_EQ(sizes(zoo::spun_wedge(0.5, 0, 0.1)), std::pair(3, 2)) << "a torque acts on a frictionless disk";
  Packing nothing;
  nothing.named_force_unit = 1;
  EXPECT_EQ(sizes(nothing), std::pair(0, 0));
}

/// Every entry, and what each row and column is.
void expect_same(const EquilibriumProblem& a, const EquilibriumProblem& b) {
  ASSERT_EQ(a.equations(), b.equations());
  ASSERT_EQ(a.unknowns(), b.unknowns());
  const auto same = [](const Eigen::SparseMatrix<double>& left, const Eigen::SparseMatrix<double>& right) {
    return test::same_entries(Eigen::MatrixXd(left), Eigen::MatrixXd(right), 0);
  };
  EXPECT_TRUE(same(a.matrix, b.matrix));
  EXPECT_TRUE(same(a.edge_matrix, b.edge_matrix));
  EXPECT_TRUE(same(a.to_edges, b.to_edges));
  EXPECT_TRUE(same(a.edge_forces, b.edge_forces));
  EXPECT_TRUE(test::same_entries(a.right_hand_sides, b.right_hand_sides, 0));
  EXPECT_EQ(a.modes, b.modes);
  EXPECT_EQ(a.disks, b.disks);
  for (std::size_t k = 0; k < a.rows.size(); ++k) {
    EXPECT_EQ(a.rows[k].body, b.rows[k].body);
    EXPECT_EQ(a.rows[k].component, b.rows[k].component);
    EXPECT_EQ(a.rows[k].unit, b.rows[k].unit);
    EXPECT_EQ(a.rows[k].load, b.rows[k].load);
  }
  for (std::size_t k = 0; k < a.contacts.size(); ++k) {
    EXPECT_EQ(a.contacts[k].a, b.contacts[k].a);
    EXPECT_EQ(a.contacts[k].b, b.contacts[k].b);
  }
}

TEST(EquilibriumProblem, WithEdgesClosedIsTheOnePosedFromThePacking) {
  Random random(6);
  for (const Packing& packing : piles()) {
    EquilibriumProblem closed = pose_equilibrium(packing);
    std::vector<ContactMode> modes = closed.modes;
    for (int step = 0; step < 3; ++step) {  // one closing after the other
      for (ContactMode& mode : modes) {
        const bool closes = random.below(4) == 0;
        if (!closes) continue;
        mode = mode == ContactMode::kStick && random.below(2) == 0
                   ? (random.below(2) == 0 ? ContactMode::kSlidePlus : ContactMode::kSlideMinus)
                   : ContactMode::kOpen;
      }
      closed = restrict_modes(closed, modes);
      expect_same(closed, pose_equilibrium(packing, modes));
    }
  }
}

TEST(EquilibriumProblem, EveryContactNamesItsEquations) {
  Random random(7);
  for (const Packing& packing : piles()) {
    const EquilibriumProblem problem = pose_equilibrium(packing, modes_by_chance(packing, random));
    for (int i = 0; i < packing.contact_count(); ++i) {
      const Contact& contact = packing[ContactId(i)];
      const ContactEnds& ends = problem.contacts[static_cast<std::size_t>(i)];
      const bool is_open = problem.modes[static_cast<std::size_t>(i)] == ContactMode::kOpen;
      ASSERT_EQ(ends.a < 0, is_open || packing[contact.a].fixed);
      ASSERT_EQ(ends.b < 0, is_open || contact.b.is_wall() || packing[contact.b.disk_id()].fixed);
      for (int k = 0; k < 2 && ends.a >= 0; ++k) {
        const EquilibriumRow& row = problem.rows[static_cast<std::size_t>(ends.a + k)];
        EXPECT_EQ(row.body, Body::disk(contact.a));
        EXPECT_EQ(row.component, k);
      }
      for (int k = 0; k < 2 && ends.b >= 0; ++k) {
        const EquilibriumRow& row = problem.rows[static_cast<std::size_t>(ends.b + k)];
        EXPECT_EQ(row.body, contact.b);
        EXPECT_EQ(row.component, k);
      }
    }
  }
}

TEST(EquilibriumProblem, ForcesUnknownsAndStrengthsAreOneStateInThreeWays) {
  Random random(8);
  for (const Packing& packing : piles()) {
    const EquilibriumProblem problem = pose_equilibrium(packing, modes_by_chance(packing, random));
    Eigen::VectorXd x(problem.unknowns());
    for (double& strength : x) strength = random.uniform(0, 3);
    const InternalForces state = problem.state(x);
    EXPECT_TRUE(test::same_entries(problem.strengths_of(state), x, 1e-13));
    const Eigen::VectorXd u = problem.unknowns_of(state);
    EXPECT_TRUE(test::same_entries(forces_of_unknowns(problem) * u, state.value(), 1e-14));
    EXPECT_TRUE(test::same_entries(problem.to_edges * u, x, 1e-13));
  }
}

}  // namespace
}  // namespace indet
