#include "libindet/barrier/verified_equations.h"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <tuple>

#include "libindet/barrier/feasibility.h"
#include "libindet/base/constants.h"
#include "libindet/base/random.h"
#include "libindet/packing/validate.h"
#include "libindet/range/analyze.h"
#include "libindet/verify/exact_check.h"
#include "tests/barrier/runs.h"
#include "tests/barrier/sets.h"
#include "tests/support/extremes.h"
#include "tests/support/rational_simplex.h"

namespace indet::barrier {
namespace {

using extremes::Scene;
using test::minimise;
using test::packings;

using test::StrengthSet;
using test::vector;

/// σ is a lower bound of the smallest singular value of S A X, and not far below it, with S the powers of two
/// that bring the rows of A X to a length between 1/√2 and √2.
TEST(VerifiedEquations, BoundTheSmallestSingularValue) {
  for (const auto& [name, packing] : packings()) {
    SCOPED_TRACE(name);
    StrengthSet set(packing);
    const AnalyticCentre centre = find_analytic_centre(set.structure, set.cholesky);
    ASSERT_TRUE(centre.found);
    const VerifiedEquations verified(set.problem, set.structure, centre);
    ASSERT_TRUE(verified.is_proven());
    const Eigen::MatrixXd AX = set.matrix() * vector(centre.x).asDiagonal();
    // Of rows that are halfway between two scales rounding chooses one.
    const auto smallest = [&](double nudge) {
      Eigen::MatrixXd scaled = AX;
      for (Eigen::Index i = 0; i < AX.rows(); ++i)
        scaled.row(i) *= std::exp2(-std::round(std::log2(AX.row(i).norm()) + nudge));
      return Eigen::JacobiSVD<Eigen::MatrixXd>(scaled).singularValues().tail(1)[0];
    };
    EXPECT_LE(verified.smallest_singular_value(), smallest(-1e-9));
    EXPECT_GE(verified.smallest_singular_value(), 0.5 * smallest(1e-9));
  }
}

TEST(VerifiedEquations, ProveNothingOfDependentRows) {
  const Packing packing = zoo::periodic_lattice(3, 2, 0.3, 0.02);  // forces of a cell: two rows follow
  const EquilibriumProblem problem = pose_equilibrium(packing);
  const std::vector<int> independent = test::independent_rows(problem);
  for (int row = 0; row < problem.equations(); ++row) {
    if (std::binary_search(independent.begin(), independent.end(), row)) continue;
    std::vector<int> rows = independent;
    rows.insert(std::upper_bound(rows.begin(), rows.end(), row), row);
    const BlockStructure structure(problem, rows);
    BlockCholesky cholesky(structure);
    const AnalyticCentre centre = find_analytic_centre(structure, cholesky);
    const VerifiedEquations verified(problem, structure, centre);
    EXPECT_FALSE(verified.is_proven());
    EXPECT_EQ(verified.smallest_singular_value(), 0);
    const Objective objective = {{0, 1.0}};
    EXPECT_EQ(verified.enclose(objective, verified.repaired(centre.x), centre.y).upper, kInfinity);
  }
}

/// A pile that friction can jam, and the same within a limit.
struct LimitedSet : StrengthSet {
  explicit LimitedSet(const Packing& packing)
      : StrengthSet(packing),
        ray(find_boundedness(structure, cholesky).ray),
        within(problem, rows, limit()) {}

  Limit limit() const {
    Limit result{{}, 1e3};
    for (std::size_t k = 0; k < ray.size(); ++k) {
      if (ray[k] > 0) result.columns.push_back(static_cast<int>(k));
    }
    return result;
  }

  std::vector<double> ray;
  BlockStructure within;
};

TEST(VerifiedEquations, ALimitIsARowAndAColumnMore) {
  const LimitedSet set(zoo::random_pile(1, 12, 1.5));
  ASSERT_FALSE(set.ray.empty());
  const BlockStructure& s = set.within;
  ASSERT_EQ(s.rows(), set.structure.rows() + 1);
  ASSERT_EQ(s.columns(), set.structure.columns() + 1);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(s.rows(), s.columns());
  const Eigen::MatrixXd all = set.problem.edge_matrix;
  for (int i = 0; i < s.rows(); ++i) {
    const int equation = s.equation_of_place()[static_cast<std::size_t>(i)];
    EXPECT_EQ(equation < 0, i == s.limit_place());
    if (equation >= 0) A.row(i).head(all.cols()) = all.row(equation);
  }
  for (const int k : s.limit().columns) A(s.limit_place(), k) = 1;
  A(s.limit_place(), s.columns() - 1) = 1;
  EXPECT_EQ(s.load()[static_cast<std::size_t>(s.limit_place())], 1e3);
  Random random(7);
  std::vector<double> x, y;
  for (int k = 0; k < s.columns(); ++k) x.push_back(random.uniform());
  for (int i = 0; i < s.rows(); ++i) y.push_back(random.uniform());
  EXPECT_LE((vector(product(s, x)) - A * vector(x)).norm(), 1e-13);
  EXPECT_LE((vector(transposed_product(s, y)) - A.transpose() * vector(y)).norm(), 1e-13);
  BlockCholesky cholesky(s);
  ASSERT_TRUE(cholesky.factor(x));
  std::vector<double> solved = y;
  cholesky.solve(solved);
  EXPECT_LE((A * vector(x).asDiagonal() * A.transpose() * vector(solved) - vector(y)).norm(), 1e-10);
}

TEST(VerifiedEquations, BoundsHoldBeyondALimit) {
  Random random(3);
  int finite = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    LimitedSet set(zoo::random_pile(seed, 12, 1.5));
    if (set.ray.empty()) continue;
    BlockCholesky cholesky(set.within);
    const AnalyticCentre centre = find_analytic_centre(set.within, cholesky);
    ASSERT_TRUE(centre.found);
    const VerifiedEquations verified(set.problem, set.within, centre);
    const Eigen::VectorXd inside = vector(centre.x).head(set.problem.unknowns());
    const Eigen::VectorXd ray = vector(set.ray);
    for (const Objective& objective : set.objectives()) {
      Eigen::VectorXd c = Eigen::VectorXd::Zero(ray.size());
      for (const auto& [k, weight] : objective) c[k] += weight;
      std::vector<double> y = centre.y;
      for (double& value : y) value *= -random.uniform();
      const double lower = verified.enclose(objective, centre.x, y).lower;
      for (const double far : {0.0, 1e6, 1e12}) EXPECT_LE(lower, c.dot(inside + far * ray));
      if (c.dot(ray) < -1e-9) {
        EXPECT_EQ(lower, -kInfinity);
      }
      finite += std::isfinite(lower) ? 1 : 0;
    }
  }
  EXPECT_GT(finite, 100);
}

TEST(VerifiedEquations, EncloseEverywhereWhatIsTheSameEverywhere) {
  for (const auto& [name, packing] : packings()) {
    SCOPED_TRACE(name);
    StrengthSet set(packing);
    const AnalyticCentre centre = find_analytic_centre(set.structure, set.cholesky);
    const VerifiedEquations verified(set.problem, set.structure, centre);
    const Eigen::MatrixXd A = set.matrix();
    for (Eigen::Index i = 0; i < A.rows(); ++i) {
      // A row of A x = b, as an objective.
      Objective objective;
      for (Eigen::Index k = 0; k < A.cols(); ++k) {
        if (A(i, k) != 0) objective.emplace_back(static_cast<int>(k), A(i, k));
      }
      const ValueBounds bounds =
          verified.enclose_everywhere(objective, verified.nearest_multipliers(objective));
      const double value = A.row(i).dot(vector(centre.x));
      const double size = std::max(1.0, A.row(i).cwiseAbs().dot(vector(centre.x)));
      EXPECT_LE(bounds.lower, value + 1e-13 * size);
      EXPECT_GE(bounds.upper, value - 1e-13 * size);
      EXPECT_LE(bounds.upper - bounds.lower, 1e-8 * size);
      // And no other multipliers make them wrong.
      const ValueBounds loose = verified.enclose_everywhere(objective, centre.y);
      EXPECT_LE(loose.lower, value);
      EXPECT_GE(loose.upper, value);
    }
  }
}

TEST(VerifiedEquations, RepairBringsAnyPointNearASolution) {
  Random random(41);
  for (const auto& [name, packing] : packings()) {
    SCOPED_TRACE(name);
    StrengthSet set(packing);
    const AnalyticCentre centre = find_analytic_centre(set.structure, set.cholesky);
    const VerifiedEquations verified(set.problem, set.structure, centre);
    std::vector<double> x = centre.x;
    for (double& entry : x) entry *= random.uniform(0, 2);
    const std::vector<double> repaired = verified.repaired(x);
    EXPECT_LE((set.matrix() * vector(repaired) - vector(set.structure.load())).norm(),
              1e-11 * vector(x).norm());
    // What solves the equations already stays where it is.
    EXPECT_LE((vector(verified.repaired(repaired)) - vector(repaired)).norm(), 1e-11 * vector(x).norm());
  }
}

/// The bounds of one objective for a number of pairs (x, y), sensible ones and absurd ones.
std::vector<ValueBounds> bounds_for_many_points(const AnalyticCentre& centre,
                                                const VerifiedEquations& verified, const Objective& objective,
                                                const test::Run& run, Random& random) {
  std::vector<ValueBounds> all;
  const auto add = [&](const std::vector<double>& x, const std::vector<double>& y) {
    all.push_back(verified.enclose(objective, verified.repaired(x), y));
    all.push_back(verified.enclose(objective, x, y));
  };
  add(run.x, run.y);
  add(centre.x, centre.y);
  const std::vector<double> no_x(run.x.size(), 0.0), no_y(run.y.size(), 0.0);
  add(no_x, no_y);
  const double away = std::pow(10.0, random.uniform(-16, 6));
  std::vector<double> x = run.x, y = run.y;
  for (double& entry : x) entry += away * random.normal();
  for (double& entry : y) entry += away * random.normal();
  add(x, run.y);
  add(run.x, y);
  x = run.x;
  y = run.y;
  for (double& entry : x) entry *= 1 + away * random.normal();
  for (double& entry : y) entry *= 1 + away * random.normal();
  add(x, y);
  // Past the extremum: from the centre through the best point, and on.
  for (std::size_t k = 0; k < x.size(); ++k) x[k] = run.x[k] + away * (run.x[k] - centre.x[k]);
  for (std::size_t i = 0; i < y.size(); ++i) y[i] = -2 * run.y[i];
  add(x, y);
  for (const double odd : {1e300, -1e300, 1e-300, kInfinity, -kInfinity, kNaN}) {
    x = run.x;
    y = run.y;
    if (!x.empty()) x[random.below(x.size())] = odd;
    if (!y.empty()) y[random.below(y.size())] = odd;
    all.push_back(verified.enclose(objective, x, y));
  }
  return all;
}

/// What became of the bounds of a scene beside the exact values.
struct Tally {
  int scenes = 0;  ///< with a centre
  int proven = 0;  ///< of these
  int bounds = 0;
  int tight = 0;       ///< of bounds for the point that the iteration found: within 1e-5
  int objectives = 0;  ///< of proven scenes
};

bool is_above(double bound, const mpq_class& value, const mpq_class& unit) {
  if (std::isinf(bound)) return bound > 0;
  return !std::isnan(bound) && mpq_class(bound) * unit >= value;
}
bool is_below(double bound, const mpq_class& value, const mpq_class& unit) {
  if (std::isinf(bound)) return bound < 0;
  return !std::isnan(bound) && mpq_class(bound) * unit <= value;
}

/// Compares strength bounds and value bounds of a scene, where it has a centre, with exact arithmetic.
void check_scene(const std::string& name, const Packing& packing, std::uint64_t seed, Tally& tally) {
  SCOPED_TRACE(name);
  StrengthSet set(packing);
  const AnalyticCentre centre = find_analytic_centre(set.structure, set.cholesky);
  if (!centre.found) return;
  for (const double x : centre.x) ASSERT_TRUE(std::isfinite(x) && x > 0);
  for (const double y : centre.y) ASSERT_TRUE(std::isfinite(y));
  ++tally.scenes;
  const VerifiedEquations verified(set.problem, set.structure, centre);
  tally.proven += verified.is_proven() ? 1 : 0;
  oracle::RationalSimplex exact(packing);
  const bool all_rows = exact.rank() == set.structure.rows();
  if (exact.is_empty()) {
    // What is proven is proven of the equations that were kept.
    EXPECT_FALSE(verified.is_proven() && set.structure.rows() == set.problem.equations()) << "it is empty";
    return;
  }
  if (verified.is_proven()) {
    EXPECT_GE(exact.rank(), set.structure.rows());
  }
  const mpq_class unit(set.problem.units.internal_in_scene());

  // 2κμ x₊ = μR + T, 2κμ x₋ = μR − T, κ x = R without friction.
  for (int k = 0; k < set.problem.unknowns(); ++k) {
    const Edge& edge = set.problem.edge(k);
    if (edge.is_slack()) continue;
    const int component = 2 * edge.contact.value();
    const double mu = set.problem.mu(edge);
    std::vector<std::pair<int, double>> terms = {{component, 1.0}};
    mpq_class times = mpq_class(edge.R);
    if (edge.sign != 0) {
      terms = {{component, mu}, {component + 1, static_cast<double>(edge.sign)}};
      times *= 2 * mpq_class(mu);
    }
    const double bound = verified.strength_bounds()[static_cast<std::size_t>(k)];
    const std::optional<mpq_class> largest = exact.extremum(terms, 1);
    if (largest) {
      EXPECT_TRUE(is_above(bound, *largest / times, unit)) << "strength " << k << ": " << bound;
    } else {
      EXPECT_EQ(bound, kInfinity) << "strength " << k;
    }
  }

  Random random(seed);
  const std::vector<Objective> objectives = set.objectives();
  std::vector<std::size_t> order(objectives.size());
  std::iota(order.begin(), order.end(), 0U);
  LockStepOptions options;
  options.gap = 1e-8;
  const std::vector<test::Run> runs = minimise(set, centre, objectives, order, options);
  for (const std::size_t k : order) {
    const int sign = k % 2 == 0 ? -1 : 1;
    std::optional<mpq_class> value = exact.extremum(2 * static_cast<int>(k / 4) + (k % 4 < 2 ? 0 : 1), sign);
    if (value && sign > 0) value = -*value;
    ASSERT_TRUE(runs[k].finished);
    const std::vector<ValueBounds> all =
        bounds_for_many_points(centre, verified, objectives[k], runs[k], random);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const ValueBounds& bounds = all[i];
      ++tally.bounds;
      if (!value) {
        EXPECT_EQ(bounds.lower, -kInfinity) << "unbounded; contact " << k / 4 << ", column " << k % 4;
        continue;
      }
      EXPECT_TRUE(is_below(bounds.lower, *value, unit))
          << "contact " << k / 4 << ", column " << k % 4 << ", point " << i << ": " << bounds.lower
          << " above " << mpq_class(*value / unit).get_d();
      if (all_rows) {
        EXPECT_TRUE(is_above(bounds.upper, *value, unit))
            << "contact " << k / 4 << ", column " << k % 4 << ", point " << i << ": " << bounds.upper
            << " below " << mpq_class(*value / unit).get_d();
      }
    }
    if (!verified.is_proven()) continue;
    ++tally.objectives;
    if (all.front().upper - all.front().lower < 1e-5 * std::max(1.0, std::abs(all.front().upper)))
      ++tally.tight;
  }
}

void expect_use(const Tally& tally, int scenes) {
  EXPECT_GE(tally.proven, scenes);
  EXPECT_GT(tally.bounds, 100 * tally.proven);
  EXPECT_GT(tally.tight, 0.9 * tally.objectives);
}

TEST(VerifiedBounds, HoldOfFixedScenesAtExtremes) {
  Tally tally;
  for (const Scene& scene : extremes::fixed_scenes())
    check_scene(scene.kind + ", " + scene.name, scene.packing, 51, tally);
  expect_use(tally, 200);
}

TEST(VerifiedBounds, HoldOfRandomScenesAtExtremes) {
  Tally tally;
  for (int seed = 0; seed < 100; ++seed) {
    const Scene scene = extremes::random_scene(static_cast<std::uint64_t>(seed), 3);
    check_scene(scene.kind + ", " + scene.name, scene.packing, 52, tally);
  }
  expect_use(tally, 15);
}

TEST(VerifiedBounds, HoldOfScenesWithLoadedWallsLeversAndFixedDisks) {
  Tally tally;
  for (int seed = 0; seed < 100; ++seed) {
    const auto number = static_cast<std::uint64_t>(seed);
    Packing packing = extremes::random_scene(number, 3).packing;
    if (seed % 2 == 0) packing = zoo::with_fixed_disks(packing, number);
    if (seed % 3 != 0) packing = zoo::with_levers(packing, number);
    if (seed % 4 == 0) packing = zoo::with_loaded_walls(packing, number);
    if (find_defect(packing)) continue;
    check_scene("seed " + std::to_string(seed), packing, 53, tally);
  }
  expect_use(tally, 20);
}

/// Columns, which stand, with everything about them driven to extremes.
Packing extreme_column(std::uint64_t seed) {
  Random random(seed);
  const auto decade = [&](double reach) { return std::pow(10.0, random.uniform(-reach, reach)); };
  Packing packing = zoo::column(1 + static_cast<int>(random.below(3)), random.uniform(0.05, 0.6), 0.3);
  const double masses = random.uniform(0, 6);
  for (Disk& disk : packing.disks) disk.mass *= decade(masses);
  for (Contact& contact : packing.contacts) {
    switch (random.below(5)) {
      case 0:
        contact.mu = 0;
        break;
      case 1:
        contact.mu = 1e3;
        break;
      case 2:
        contact.mu = decade(6);
        break;
      default:
        contact.mu = random.uniform(0.1, 0.6);
    }
  }
  for (Disk& disk : packing.disks) {
    if (random.below(3) == 0) disk.load = {0.1 * random.normal() * decade(6), -decade(6), 0};
    if (random.below(4) == 0) disk.load.z() = 1e-2 * random.normal() * decade(3);
  }
  // Walls beside walls, off by a hair.
  if (random.below(2) == 0) {
    const Contact contact = packing.contacts[random.below(packing.contacts.size())];
    if (contact.b.is_wall()) {
      Wall wall = packing[contact.b.wall_id()];
      wall.id = packing.wall_count() + 1;
      const double angle = std::pow(10.0, random.uniform(-16, -1));
      wall.normal = (wall.normal + angle * wall.tangent()).normalized();
      Contact beside = contact;
      beside.normal = wall.normal;
      wall.point = packing[contact.a].position - packing[contact.a].radius * wall.normal;
      beside.b = Body::wall(WallId(packing.wall_count()));
      packing.walls.push_back(wall);
      packing.contacts.push_back(beside);
    }
  }
  return packing;
}

TEST(VerifiedBounds, HoldOfColumnsDrivenToExtremes) {
  Tally tally;
  for (int seed = 0; seed < 100; ++seed) {
    const Packing packing = extreme_column(static_cast<std::uint64_t>(seed));
    ASSERT_FALSE(find_defect(packing)) << find_defect(packing)->reason;
    check_scene("seed " + std::to_string(seed), packing, 54, tally);
  }
  expect_use(tally, 40);
}

/// Bounds of forces and imposed stress, against exact bases.
TEST(VerifiedBounds, HoldOfBoundedForcesAndImposedStress) {
  const Packing cases[] = {test::bounded_pile(), zoo::periodic_lattice(2, 2, 0.3, 0.02),
                           zoo::periodic_lattice(1, 3, 0.4, 0.01)};
  for (const Packing& packing : cases) {
    StrengthSet set(packing);
    const AnalyticCentre centre = find_analytic_centre(set.structure, set.cholesky);
    ASSERT_TRUE(centre.found);
    const VerifiedEquations verified(set.problem, set.structure, centre);
    ASSERT_TRUE(verified.is_proven());
    const ExactCheck exact = check_exactly(packing, analyze(packing, options_for(Accuracy::kFast)));
    ASSERT_EQ(exact.rank, set.structure.rows());
    const mpq_class unit(set.problem.units.internal_in_scene());
    Random random(55);
    const std::vector<Objective> objectives = set.objectives();
    std::vector<std::size_t> order(objectives.size());
    std::iota(order.begin(), order.end(), 0U);
    const std::vector<test::Run> runs = minimise(set, centre, objectives, order, {});
    for (const std::size_t k : order) {
      const auto row = static_cast<Eigen::Index>(k / 4);
      const auto column = static_cast<Eigen::Index>(k % 4);
      // The exact value is between two doubles.
      double least = exact.lower(row, column), most = exact.upper(row, column);
      ASSERT_TRUE(std::isfinite(least) && std::isfinite(most));
      if (k % 2 == 1) std::tie(least, most) = std::pair(-most, -least);
      const std::vector<ValueBounds> all =
          bounds_for_many_points(centre, verified, objectives[k], runs[k], random);
      for (const ValueBounds& bounds : all) {
        EXPECT_TRUE(is_below(bounds.lower, mpq_class(most), unit))
            << k << ": " << bounds.lower << ", " << most;
        EXPECT_TRUE(is_above(bounds.upper, mpq_class(least), unit))
            << k << ": " << bounds.upper << ", " << least;
      }
      EXPECT_LT(all.front().upper - all.front().lower, 1e-5 * std::max(1.0, std::abs(all.front().upper)));
    }
  }
}

}  // namespace
}  // namespace indet::barrier
