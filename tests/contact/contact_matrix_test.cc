#include "libindet/contact/contact_matrix.h"

#include <gtest/gtest.h>

#include <vector>

#include "libindet/base/random.h"
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
  }
  return result;
}

/// Rows of the paper's matrix that an equation stands for, torque rows divided by the radius.
Eigen::MatrixXd rows_of(const Packing& packing, const ContactMatrix& contacts, const Eigen::MatrixXd& paper) {
  Eigen::MatrixXd result(contacts.equations(), paper.cols());
  for (int i = 0; i < contacts.equations(); ++i) {
    const EquilibriumRow& row = contacts.rows[static_cast<std::size_t>(i)];
    result.row(i) = paper.row(3 * row.disk.value() + row.component);
    if (row.component == 2) result.row(i) /= packing[row.disk].radius;
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

TEST(ContactMatrix, IsThePapersMatrixInEveryMode) {
  Random random(3);
  for (const Packing& packing : piles()) {
    for (int repeat = 0; repeat < 4; ++repeat) {
      const auto modes = repeat == 0 ? natural_modes(packing) : modes_by_chance(packing, random);
      const ContactMatrix contacts = build_contact_matrix(packing, modes);
      const Eigen::MatrixXd paper = oracle::paper_matrix(packing);
      const Eigen::MatrixXd kept = rows_of(packing, contacts, paper);
      EXPECT_TRUE(test::same_entries(kept * Eigen::MatrixXd(contacts.forces),
                                     Eigen::MatrixXd(contacts.matrix), 1e-15));
      EXPECT_TRUE(test::same_entries(kept * Eigen::MatrixXd(contacts.edge_forces),
                                     Eigen::MatrixXd(contacts.edge_matrix), 1e-15));
      EXPECT_TRUE(test::same_entries(rows_of(packing, contacts, oracle::paper_wrench(packing)),
                                     contacts.wrench, 1e-15));
      // What is left out would read 0 = 0.
      const Eigen::VectorXd generic = Eigen::VectorXd::LinSpaced(contacts.unknowns(), 1, 2);
      Eigen::VectorXd balance = paper * (contacts.forces * generic) + oracle::paper_wrench(packing);
      for (const EquilibriumRow& row : contacts.rows) balance[3 * row.disk.value() + row.component] = 0;
      EXPECT_EQ(balance.lpNorm<Eigen::Infinity>(), 0);
    }
  }
}

TEST(ContactMatrix, EdgesAreTheConesOfTheContacts) {
  Random random(4);
  for (const Packing& packing : piles()) {
    const ContactMatrix contacts = build_contact_matrix(packing, modes_by_chance(packing, random));
    const Eigen::MatrixXd to_edges = contacts.to_edges;
    ASSERT_EQ(static_cast<int>(contacts.edges.size()), contacts.unknowns());
    // Edge strengths and unknowns describe the same forces, and edges are edges: T = ±μR, R > 0.
    EXPECT_TRUE(test::same_entries(Eigen::MatrixXd(contacts.edge_forces) * to_edges,
                                   Eigen::MatrixXd(contacts.forces), 1e-14));
    for (int k = 0; k < contacts.unknowns(); ++k) {
      const Edge& edge = contacts.edges[static_cast<std::size_t>(k)];
      const double mu = packing[edge.contact].mu;
      EXPECT_GT(edge.R, 0);
      EXPECT_LE(std::max(edge.R, std::abs(edge.T)), 1);
      EXPECT_DOUBLE_EQ(edge.T, edge.sign * mu * edge.R);
      Eigen::VectorXd force = Eigen::VectorXd::Zero(2 * packing.contact_count());
      force[2 * edge.contact.value()] = edge.R;
      force[2 * edge.contact.value() + 1] = edge.T;
      EXPECT_TRUE(
          test::same_entries(contacts.edge_forces * Eigen::VectorXd::Unit(contacts.unknowns(), k), force, 0));
    }
  }
}

TEST(ContactMatrix, HoldsOnlyWhatTheSceneNeeds) {
  const auto sizes = [](const Packing& packing) {
    const ContactMatrix contacts = build_contact_matrix(packing, natural_modes(packing));
    return std::pair(contacts.equations(), contacts.unknowns());
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

TEST(ContactMatrix, ResidualIsTheOneOfThePapersEquations) {
  Random random(5);
  for (const Packing& packing : piles()) {
    Eigen::VectorXd forces(2 * packing.contact_count());
    for (double& force : forces) force = random.uniform(-3, 3) * packing.force_unit();
    const Eigen::VectorXd balance =
        oracle::paper_matrix(packing) * forces / packing.force_unit() + oracle::paper_wrench(packing);
    const auto residual = equilibrium_residual(packing, forces);
    for (int i = 0; i < packing.disk_count(); ++i) {
      EXPECT_NEAR(residual(i, 0), balance[3 * i], 1e-13);
      EXPECT_NEAR(residual(i, 1), balance[3 * i + 1], 1e-13);
      EXPECT_NEAR(residual(i, 2), balance[3 * i + 2] / packing[DiskId(i)].radius, 1e-13);
    }
  }
}

TEST(ContactMatrix, CoulombCountSortsContacts) {
  Packing packing = zoo::column(3, 0.5, 0.5);  // 6 contacts
  packing.contacts[5].mu = 0;
  packing.gravity = {0, -2};  // force unit 2: forces below are halved
  Eigen::VectorXd forces(12);
  forces << 2, 0.4,  // sticks
      2, -1,         // slides
      1e-12, 0,      // transmits nothing
      -0.2, 0,       // pulls
      2, 1.2,        // beyond friction by 0.2
      2, 0;          // frictionless: always "slides", not counted
  const CoulombCount count = count_coulomb(packing, forces, 1e-9);
  EXPECT_EQ(count.non_transmitting, 1);
  EXPECT_EQ(count.violated, 2);
  EXPECT_NEAR(count.worst_violation, 0.1, 1e-15);
  EXPECT_EQ(count.sliding, 1 + 2 + 2);  // slides, nothing (twice), and the two violated ones
}

}  // namespace
}  // namespace indet
