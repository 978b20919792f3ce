#include "libindet/exact/optimum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "libindet/exact/certificate.h"
#include "libindet/exact/ray.h"
#include "tests/support/extremes.h"
#include "tests/support/periodic_lattice.h"
#include "tests/support/rational_simplex.h"
#include "tests/support/scene_builder.h"
#include "tests/support/zoo.h"

namespace indet::exact {
namespace {

std::shared_ptr<const ContactBasis> any_basis(const ContactProblem& problem) {
  const std::vector<double> preference(static_cast<std::size_t>(problem.edges()), 0);
  return ContactBasis::create(problem, problem.choose_basis(preference));
}

TEST(EdgeStrengths, AddUpToTheForces) {
  Packing packing = zoo::wedge(0.5, 0.25);
  packing.contacts[1].mu = 0;
  const std::vector<double> x = edge_strengths(packing, std::vector<double>{3, -0.5, 2, 0});
  ASSERT_EQ(x.size(), 4);
  EXPECT_EQ(x[0] + x[1], 3);
  EXPECT_EQ(0.25 * (x[0] - x[1]), -0.5);
  EXPECT_EQ(x[2], 2) << "R itself without friction";
}

/// sin and cos as stored: then the forces of the groove are rational.
TEST(ContactBasis, GivesTheForcesOfTheGroove) {
  const Packing packing = zoo::wedge(0.5, 0.3);
  const ContactProblem problem(packing);
  EXPECT_EQ(problem.rank(), 3);
  // Both contacts slide with T = +μR on contact 0, −μR on contact 1: R = 1 / (2 (n_y − μ n_x)).
  const auto basis = ContactBasis::create(problem, {0, 1, 3});
  ASSERT_TRUE(basis);
  const mpq_class nx(packing.contacts[0].normal.x());
  const mpq_class ny(packing.contacts[0].normal.y());
  const mpq_class mu(0.3);
  const mpq_class largest = 1 / (2 * (ny - mu * nx));
  EXPECT_EQ(basis->force(0), largest);
  EXPECT_EQ(basis->force(1), mu * largest);
  EXPECT_EQ(basis->force(3), -mu * largest);
  EXPECT_EQ(basis->first_negative(), -1);
  const Optimum top = maximise(problem, any_basis(problem), {0, 1}, 50);
  EXPECT_EQ(top.verdict, Verdict::kOptimal);
  EXPECT_EQ(top.basis->sum({0, 1}), largest);
  const Optimum bottom = maximise(problem, any_basis(problem), {0, -1}, 50);
  EXPECT_EQ(bottom.basis->sum({0, -1}), mpq_class(1 / (2 * (ny + mu * nx))));
}

/// From any basis the criss-cross walk reaches what the textbook tableau finds.
TEST(Optimum, AgreesWithTheTableauOnRandomScenes) {
  int empty = 0;
  int unbounded = 0;
  for (std::uint64_t seed = 0; seed < 120; ++seed) {
    const extremes::Scene scene = extremes::random_scene(seed, 3);
    SCOPED_TRACE(scene.kind + scene.name);
    const ContactProblem problem(scene.packing);
    oracle::RationalSimplex tableau(scene.packing);
    if (scene.packing.contact_count() == 0) continue;
    const Optimum solution = find_solution(problem, any_basis(problem), 1000);
    if (tableau.is_empty()) {
      ++empty;
      EXPECT_TRUE(solution.verdict == Verdict::kEmpty || solution.verdict == Verdict::kInconsistent);
      continue;
    }
    ASSERT_EQ(solution.verdict, Verdict::kOptimal);
    EXPECT_EQ(problem.rank(), tableau.rank());
    for (int component = 0; component < 2 * scene.packing.contact_count(); ++component) {
      for (const int sign : {-1, 1}) {
        const Optimum found = maximise(problem, solution.basis, {component, sign}, 1000);
        const auto exact = tableau.extremum(component, sign);
        unbounded += exact ? 0 : 1;
        ASSERT_EQ(found.verdict, exact ? Verdict::kOptimal : Verdict::kUnbounded);
        if (exact) {
          ASSERT_EQ(found.basis->sum({component, sign}), *exact);
          ASSERT_EQ(enclose(found.value).lower, enclose(*exact).lower);
          ASSERT_EQ(enclose(found.value).upper, enclose(*exact).upper);
          ASSERT_EQ(nearest(found.value), nearest(*exact));
        }
      }
    }
  }
  EXPECT_GT(empty, 5);
  EXPECT_GT(unbounded, 20);
}

TEST(Certificate, AMotionWithRoundingBecomesExact) {
  // On an incline the disk rolls down: it turns and moves along the plane, (cos, −sin), rω = −1.
  const Packing packing = zoo::disk_on_incline(0.3, 0.5);
  const ContactProblem problem(packing);
  std::vector<double> motion(3);
  motion[static_cast<std::size_t>(problem.row(Body::disk(DiskId(0)), 0))] = std::cos(0.3) + 1e-13;
  motion[static_cast<std::size_t>(problem.row(Body::disk(DiskId(0)), 1))] = -std::sin(0.3);
  motion[static_cast<std::size_t>(problem.row(Body::disk(DiskId(0)), 2))] = -1;
  EXPECT_TRUE(proves_emptiness(problem, motion, 1e-9));
  for (double& velocity : motion) velocity = -velocity;
  EXPECT_FALSE(proves_emptiness(problem, motion, 1e-9)) << "uphill";
  motion = {0, 1, 0};
  EXPECT_FALSE(proves_emptiness(problem, motion, 1e-9)) << "away from the load";
  EXPECT_FALSE(proves_emptiness(ContactProblem(zoo::wedge(0.3, 0.5)), std::vector<double>{0, -1, 0}, 1e-9));
}

TEST(Certificate, TellsARayFromNearlyOne) {
  // The groove of tan φ = 1 jams for μ > 1: along x₊ of contact 0 and x₋ of contact 1, and the others a
  // little.
  const auto ray = [&](double mu, double share) {
    const ContactProblem problem(zoo::wedge(std::atan(1.0), mu));
    // R n̂ + T t̂ is horizontal for T = R on contact 0, T = −R on contact 1; x± = (R ± T/μ) / 2.
    const double T = 1 / mu;
    return proves_ray(problem,
                      std::vector<double>{(1 + T) / 2, share * (1 - T) / 2, share * (1 - T) / 2, (1 + T) / 2},
                      1e-9);
  };
  EXPECT_TRUE(ray(1.5, 1));
  EXPECT_FALSE(ray(1.5, 0)) << "without its second edges it does not balance";
  EXPECT_FALSE(ray(0.9, 1));
}

/// Square arrays of disks in a box, turned so that normals are rounded, are pressed along rows and columns:
/// near that ray is an exact one.
TEST(Certificate, ProvesTheRayOfAConfinedArray) {
  constexpr int kSide = 6;
  const double c = std::cos(0.3), s = std::sin(0.3);
  const auto turned = [&](double x, double y) { return Vector2(c * x - s * y, s * x + c * y); };
  Packing packing = zoo::empty_scene();
  const auto wall = [&](double x, double y, double p, double q) {
    return Body::wall(zoo::add_wall(packing, turned(x, y), turned(p, q)));
  };
  const double end = 2.0 * kSide;
  const Body left = wall(0, 0, 1, 0), right = wall(end, 0, -1, 0);
  const Body floor = wall(0, 0, 0, 1), lid = wall(0, end, 0, -1);
  for (int i = 0; i < kSide; ++i) {
    for (int j = 0; j < kSide; ++j) {
      const DiskId disk = zoo::add_disk(packing, turned(2 * i + 1, 2 * j + 1));
      zoo::touch(packing, disk, i == 0 ? left : Body::disk(DiskId(disk.value() - kSide)), 0.3);
      zoo::touch(packing, disk, j == 0 ? floor : Body::disk(DiskId(disk.value() - 1)), 0.3);
      if (i == kSide - 1) zoo::touch(packing, disk, right, 0.3);
      if (j == kSide - 1) zoo::touch(packing, disk, lid, 0.3);
    }
  }
  const ContactProblem problem(packing);
  std::vector<double> strengths(static_cast<std::size_t>(problem.edges()), 0.5);
  EXPECT_TRUE(proves_ray(problem, strengths, 1e-9));
  for (std::size_t e = 0; e < strengths.size(); ++e) strengths[e] += 1e-10 * std::sin(static_cast<double>(e));
  EXPECT_TRUE(proves_ray(problem, strengths, 1e-9)) << "one is near";
  strengths[0] += 1e-3;
  EXPECT_FALSE(proves_ray(problem, strengths, 1e-9)) << "none is near";
  strengths[0] = strengths[1] = 0;
  EXPECT_FALSE(proves_ray(problem, strengths, 1e-9)) << "the first row leans on nothing";
}

TEST(Certificate, ProvesRankAndClosedEdges) {
  // Corner with μ_wall < 1: the wall carries nothing. x: R_wall + T_floor = 0; torque: T_floor + T_wall = 0.
  const ContactProblem corner(zoo::corner(0.3, 0.5));
  std::vector<double> motion(3, 0);
  motion[static_cast<std::size_t>(corner.row(Body::disk(DiskId(0)), 0))] = 1;
  motion[static_cast<std::size_t>(corner.row(Body::disk(DiskId(0)), 2))] = -1;
  // The floor contact rolls; the wall opens by 1 and slips by 1, so that its power R ± T with |T| ≤ R/2 is
  // positive.
  EXPECT_TRUE(proves_structure(corner, std::vector<Closing>{{{2, 3}, motion}}, 2));
  EXPECT_FALSE(proves_structure(corner, std::vector<Closing>{{{2, 3}, motion}}, 3));
  EXPECT_FALSE(proves_structure(corner, std::vector<Closing>{{{0}, motion}}, 2));
  EXPECT_TRUE(proves_structure(corner, {}, 3));
  // One disk on the floor: two of its three equations say T = 0.
  EXPECT_TRUE(proves_structure(ContactProblem(zoo::disk_on_floor(0.3)), {}, 2));
  // A normal that is not parallel to the load in its last digit: nothing balances exactly.
  Packing turned = zoo::rotated(zoo::disk_on_floor(0.3), 0.7);
  turned.contacts[0].normal.x() += 1e-15;
  EXPECT_FALSE(proves_structure(ContactProblem(turned), {}, 2));
}

TEST(Certificate, FindsTheRowsThatADependentRowFollowsFrom) {
  // Disks on a floor beside a groove: of each lone disk two of three equations say T = 0.
  Packing packing = zoo::wedge(0.4, 0.3);
  const WallId floor = zoo::add_wall(packing, {0, -100}, {0, 1});
  for (int k = 0; k < 60; ++k) {
    const DiskId disk = zoo::add_disk(packing, {3.0 * k, -99});
    zoo::touch(packing, disk, Body::wall(floor), 0.3);
  }
  const ContactProblem problem(packing);
  EXPECT_EQ(problem.rows(), 183);
  EXPECT_EQ(problem.rank(), 123);
  EXPECT_TRUE(proves_structure(problem, {}, 123));
  EXPECT_FALSE(proves_structure(problem, {}, 124));
  // A torque on one of them contradicts its other equations.
  packing.disks.back().load.z() = 1e-300;
  EXPECT_FALSE(proves_structure(ContactProblem(packing), {}, 123));
}

TEST(Certificate, ProvesRowsThatAddUpToNothingHoweverManyTheyAre) {
  // In a cell the forces along x, and along y, of all disks cancel; three rows are of the stress.
  Packing packing = zoo::periodic_lattice(9, 9, 0.5, 0.02);
  constexpr int kRank = 3 * 81 - 2 + 3;
  constexpr std::size_t kFewRows = 10;
  EXPECT_TRUE(proves_structure(ContactProblem(packing), {}, kRank, kFewRows));
  EXPECT_FALSE(proves_structure(ContactProblem(packing), {}, kRank + 1, kFewRows));
  // A load on one of them has nothing to balance it.
  packing.disks[5].load.y() = 1e-300;
  EXPECT_FALSE(proves_structure(ContactProblem(packing), {}, kRank, kFewRows));
}

TEST(Certificate, FindsADependentRowThatFollowsFromAllOthers) {
  // A frictionless chain between two walls: its horizontal equations, a wall's too, sum up to 0 = 0 but for
  // the wall that is loaded.
  for (const double load : {2.0, 2.0000000001}) {
    Packing packing = zoo::empty_scene();
    packing.gravity = {0, 0};
    const WallId left = zoo::add_wall(packing, {0, 0}, {1, 0});
    const WallId right = zoo::add_wall(packing, {20, 0}, {-1, 0});
    packing.walls[0].load_n = 2;
    packing.walls[1].load_n = load;
    for (int k = 0; k < 10; ++k) zoo::add_disk(packing, {2.0 * k + 1, 0});
    zoo::touch(packing, DiskId(0), Body::wall(left), 0);
    for (int k = 1; k < 10; ++k) zoo::touch(packing, DiskId(k), Body::disk(DiskId(k - 1)), 0);
    zoo::touch(packing, DiskId(9), Body::wall(right), 0);
    const ContactProblem problem(packing);
    EXPECT_EQ(problem.rank(), 11);
    EXPECT_EQ(proves_structure(problem, {}, 11), load == 2.0) << load;
  }
}

}  // namespace
}  // namespace indet::exact
