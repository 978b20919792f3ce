#include "libindet/verify/verify.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "libindet/range/analyze.h"
#include "libindet/range/promise.h"
#include "libindet/verify/affine_hull.h"
#include "libindet/verify/exact_check.h"
#include "tests/support/body_variants.h"
#include "tests/support/periodic_lattice.h"
#include "tests/support/scene_builder.h"
#include "tests/support/zoo.h"
#include "tests/verify/first_message.h"

namespace indet {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

void expect_contradiction(const Packing& packing, const ForceRanges& wrong, const std::string& text) {
  const Verification found = verify_ranges(packing, wrong);
  EXPECT_EQ(found.contradictions, 1) << text;
  EXPECT_THAT(found.messages, Contains(HasSubstr(text)));
}

TEST(VerifyRanges, CountsOfAPackingThatCannotStand) {
  const Packing packing = zoo::disk_on_incline(0.2, 1);
  const ForceRanges good = analyze(packing);
  const Verification found = verify_ranges(packing, good);
  EXPECT_TRUE(found.passed()) << first_message(found);
  EXPECT_EQ(found.states, 0);
  EXPECT_TRUE(std::isnan(found.worst_imbalance));
  EXPECT_TRUE(std::isnan(found.worst_optimality_gap));
  ForceRanges wrong = good;
  wrong.objectives += 4;
  expect_contradiction(packing, wrong, "objectives: 8 is stored, 4 is right");
  wrong = good;
  wrong.value(0, kMaxR) = 3;
  EXPECT_FALSE(verify_ranges(packing, wrong).passed());
}

TEST(VerifyRanges, CountsAndWorstResiduals) {
  const Packing packing = zoo::column(3, 0.3, 0.5);
  const ForceRanges good = analyze(packing);
  EXPECT_TRUE(verify_ranges(packing, good).passed()) << first_message(verify_ranges(packing, good));
  const auto with = [&](auto change) {
    ForceRanges wrong = good;
    change(wrong);
    return wrong;
  };
  expect_contradiction(packing, with([](ForceRanges& r) { ++r.blocks; }), "blocks");
  expect_contradiction(packing, with([](ForceRanges& r) { ++r.determined; }), "determined");
  expect_contradiction(packing, with([](ForceRanges& r) { --r.equations; }), "equations");
  expect_contradiction(packing, with([](ForceRanges& r) { r.worst_primal_residual *= 2; }),
                       "worst_primal_residual");
  expect_contradiction(packing, with([](ForceRanges& r) { r.worst_dual_residual += 1e-10; }),
                       "worst_dual_residual");
  expect_contradiction(packing, with([](ForceRanges& r) { r.doubtful = true; }), "doubtful");
}

TEST(VerifyRanges, AcceptsLeversAndFixedDisks) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const Packing packing =
        zoo::with_levers(zoo::with_fixed_disks(zoo::random_pile(seed, 8, 0.6), seed), seed);
    const Verification found = verify_ranges(packing, analyze(packing));
    EXPECT_TRUE(found.passed()) << seed << ": " << first_message(found);
  }
}

TEST(VerifyRanges, ReadsLeversAndFixedDisksItself) {
  const Packing packing = zoo::disk_on_two_fixed(0.5, 0.3, 1, 2);
  const ForceRanges good = analyze(packing);
  Packing other = packing;
  other.contacts[0].lever_a = 0.9;
  EXPECT_FALSE(verify_ranges(other, good).passed());
  other = packing;
  other.disks[1].fixed = false;
  other.gravity = {0, -1.0 / 4};  // the same mean weight, (1 + 7) / 2 of them
  EXPECT_FALSE(verify_ranges(other, good).passed());
}

TEST(VerifyRanges, FixedDisksDoNotMove) {
  Packing packing = zoo::disk_on_two_fixed(0.5, 0.3, 1, 2);
  packing.contacts.pop_back();
  ForceRanges wrong = analyze(packing);
  ASSERT_EQ(wrong.status, PolytopeStatus::kEmpty);
  EXPECT_TRUE(verify_ranges(packing, wrong).passed());
  wrong.motion(1, 0) = 0.5;
  expect_contradiction(packing, wrong, "disk 2 is fixed, but moves");
}

/// A disk between two walls, of which rounding has turned one by so little that forces grow along a ray on
/// which T of contact 0 grows by 6e-17 of R.
Packing disk_between_nearly_opposite_walls() {
  Packing packing = zoo::empty_scene();
  packing.gravity = {0.3, -1};
  const DiskId disk = zoo::add_disk(packing, {0, 0});
  for (const Vector2& normal : {Vector2(1, 0), Vector2(-1, 1.2246467991473532e-16)})
    zoo::touch(packing, disk, Body::wall(zoo::add_wall(packing, -normal, normal)), 10);
  return packing;
}

TEST(VerifyRanges, AValueWithoutABoundIsNotCertified) {
  const Packing packing = disk_between_nearly_opposite_walls();
  AnalyzeOptions options;
  options.exactness = AnalyzeOptions::Exactness::kNowhere;
  const ForceRanges ranges = analyze(packing, options);
  EXPECT_EQ(ranges.upper(0, kMaxT), std::numeric_limits<double>::infinity());
  EXPECT_EQ(ranges.outcome(0, kMaxT), Outcome::kImprecise) << ranges.value(0, kMaxT);
  for (Eigen::Index i = 0; i < 2; ++i) {
    for (int column = 0; column < 4; ++column)
      EXPECT_TRUE(ranges.outcome(i, column) != Outcome::kOptimal ||
                  std::isfinite(ranges.upper(i, column) - ranges.lower(i, column)));
  }
  EXPECT_TRUE(verify_ranges(packing, ranges).passed()) << first_message(verify_ranges(packing, ranges));
  ForceRanges wrong = ranges;
  wrong.outcome(0, kMaxT) = Outcome::kOptimal;
  wrong.certified += 1;
  wrong.imprecise -= 1;
  expect_contradiction(packing, wrong, "certified, but its bounds are inf apart");
}

/// Certified values against rational arithmetic, relative to the loads at their contacts; returns how many.
int expect_promise_is_held(const Packing& packing, const ForceRanges& ranges) {
  const ExactCheck exact = check_exactly(packing, ranges);
  const Eigen::VectorXd loads = loads_at_contacts(packing);
  int certified = 0;
  for (Eigen::Index i = 0; i < ranges.outcome.rows(); ++i) {
    for (int column = 0; column < 4; ++column) {
      if (ranges.outcome(i, column) != Outcome::kOptimal) continue;
      ++certified;
      const double middle = exact.lower(i, column) / 2 + exact.upper(i, column) / 2;
      EXPECT_NEAR(ranges.value(i, column), middle, 1.001 * promised_width(middle, loads[i]))
          << i << ' ' << column;
      EXPECT_LE(ranges.lower(i, column), exact.upper(i, column));
      EXPECT_GE(ranges.upper(i, column), exact.lower(i, column));
    }
  }
  return certified;
}

TEST(VerifyRanges, CertifiedValuesAreRightRelativeToTheLoadsAtTheirContacts) {
  int finite = 0, certified = 0, unbounded = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    Packing packing = zoo::random_pile(seed, 5, seed % 2 == 0 ? 1 : 0.5);
    // Some are light.
    for (std::size_t i = 0; i < packing.disks.size(); i += 2)
      packing.disks[i].mass *= seed % 4 < 2 ? 1e-10 : 1;
    const ForceRanges ranges = analyze(packing);
    certified += expect_promise_is_held(packing, ranges);
    finite += static_cast<int>(ranges.value.isFinite().count());
    unbounded += ranges.status == PolytopeStatus::kUnbounded ? 1 : 0;
    EXPECT_TRUE(verify_ranges(packing, ranges).passed())
        << seed << ": " << first_message(verify_ranges(packing, ranges));
  }
  EXPECT_GT(unbounded, 2);
  EXPECT_GT(certified, 0.9 * finite);
}

TEST(VerifyRanges, WhatIsStoredOfAMotionIsWhatIsProven) {
  // A disk on a floor that is tilted by so little rolls down (1, −t, −1) all the same.
  for (const double t : {2e-10, 5e-10, 9e-10}) {
    const Packing packing = zoo::disk_on_incline(t, 0.5);
    for (const Method method : {Method::kLp, Method::kBarrier}) {
      AnalyzeOptions options;
      options.method = method;
      const ForceRanges ranges = analyze(packing, options);
      ASSERT_EQ(ranges.status, PolytopeStatus::kEmpty);
      EXPECT_FALSE(ranges.doubtful);
      EXPECT_NEAR(std::abs(ranges.motion(0, 1) / t), 1, 1e-6) << t;
      EXPECT_TRUE(verify_ranges(packing, ranges).passed()) << first_message(verify_ranges(packing, ranges));
      ForceRanges wrong = ranges;
      wrong.motion(0, 1) = 0;
      expect_contradiction(packing, wrong, "the load does no work");
      wrong.motion(0, 1) = -t;
      wrong.motion(0, 2) *= -1;
      expect_contradiction(packing, wrong, "some contact resists it");
      wrong = ranges;
      wrong.motion.row(0) << 1e-11, -1, 0;
      wrong.motion(0, 1) =
          -1e-10;  // resisted by less than is told from rounding, and by no other motion near
      expect_contradiction(packing, wrong, "no exact motion near to it");
    }
  }
}

TEST(VerifyRanges, AcceptsLoadedWalls) {
  for (const Packing& packing : {zoo::disks_between_plates(3, 2, 0.3), zoo::biaxial_box(3, 2, 1, 2, 0.4)}) {
    const ForceRanges good = analyze(packing);
    EXPECT_TRUE(verify_ranges(packing, good).passed()) << first_message(verify_ranges(packing, good));
    EXPECT_TRUE(check_exactly(packing, good).passed());
    Packing other = packing;
    for (Wall& wall : other.walls) wall.load_n *= 1.001;
    EXPECT_FALSE(verify_ranges(other, good).passed());
  }
}

TEST(VerifyRanges, ChecksTheMotionOfLoadedWalls) {
  Packing packing = zoo::disks_between_plates(1, 2.5, 0.3);
  packing.walls[1].load_t = 0.1;
  const ForceRanges good = analyze(packing);
  EXPECT_TRUE(verify_ranges(packing, good).passed()) << first_message(verify_ranges(packing, good));
  EXPECT_TRUE(check_exactly(packing, good).proves_emptiness);
  ForceRanges wrong = good;
  wrong.wall_motion(0, 0) = 0.5;
  EXPECT_FALSE(verify_ranges(packing, wrong).passed());
  wrong = good;
  wrong.wall_motion *= -1;
  EXPECT_FALSE(verify_ranges(packing, wrong).passed());
}

TEST(VerifyRanges, AcceptsCells) {
  for (const double mu : {0.0, 0.3}) {
    Packing packing = zoo::periodic_lattice(2, 2, mu, 0.02);
    const ForceRanges good = analyze(packing);
    EXPECT_TRUE(verify_ranges(packing, good).passed()) << first_message(verify_ranges(packing, good));
    EXPECT_TRUE(check_exactly(packing, good).passed());
    Packing other = packing;
    other.stress.xy *= 1.001;
    EXPECT_FALSE(verify_ranges(other, good).passed());
    EXPECT_FALSE(check_exactly(other, good).passed());
    other = packing;
    *other.cell.b *= 1.001;
    EXPECT_FALSE(verify_ranges(other, good).passed());
  }
}

TEST(VerifyRanges, ChecksTheMotionOfCells) {
  for (const bool isotropic : {true, false}) {
    Packing packing = zoo::periodic_lattice(2, 2, 0.3, 0.02);
    packing.stress = {};
    (isotropic ? packing.stress.pressure : packing.stress.yy) = -1;
    const ForceRanges good = analyze(packing);
    ASSERT_EQ(good.status, PolytopeStatus::kEmpty);
    EXPECT_TRUE(verify_ranges(packing, good).passed()) << first_message(verify_ranges(packing, good));
    EXPECT_TRUE(check_exactly(packing, good).proves_emptiness);
    const auto refuses = [&](auto change) {
      ForceRanges wrong = good;
      change(wrong.cell_motion);
      return !verify_ranges(packing, wrong).passed();
    };
    EXPECT_FALSE(refuses([](auto&) {}));
    EXPECT_TRUE(refuses([](auto& motion) { motion *= -1; })) << "the load does no work";
    EXPECT_TRUE(refuses([](auto& motion) { motion(0, 0) += 0.1; })) << "not free, or not isotropic";
    EXPECT_TRUE(refuses([](auto& motion) { motion(0, 1) += 0.1; }));
    EXPECT_TRUE(refuses([](auto& motion) { motion(1, 0) += 0.1; }));
    EXPECT_TRUE(refuses([](auto& motion) { motion.conservativeResize(1, 2); }));
  }
}

ForceRanges with_duals(const Packing& packing, double gap = 1e-6) {
  AnalyzeOptions options;
  options.method = Method::kBarrier;
  options.gap = gap;
  options.states.kind = StateChoice::Kind::kNone;
  options.duals.kind = DualChoice::Kind::kAll;
  return analyze(packing, options);
}

/// Friction and none, closed edges, loaded walls, imposed stress, bounds of forces.
std::vector<Packing> bounded_packings() {
  Packing bounds = zoo::wedge(0.4, 0.3);
  bounds.contacts[0].R_lo = 0.5;
  bounds.contacts[0].R_hi = 0.55;
  bounds.contacts[1].T_hi = 0.1;
  return {zoo::wedge(0.4, 0.3),
          zoo::disk_on_floor(0.3),
          zoo::corner(0.4, 1),
          zoo::corner(0.4, 0.9),
          zoo::wedge_and_corner(0.4, 0.3),
          zoo::column(9, 0.4, 0.3),
          zoo::disk_on_two_fixed(0.5, 0.3, 1, 2),
          zoo::biaxial_box(3, 2, 1, 1.2, 0.2),
          zoo::rack(2),
          zoo::periodic_lattice(3, 3, 0.2, 0.02),
          bounds};
}

TEST(VerifyRanges, ProvesValuesByStoredMultipliers) {
  for (const double gap : {1e-2, 1e-7}) {
    for (const Packing& packing : bounded_packings()) {
      SCOPED_TRACE(packing.origin.protocol);
      const ForceRanges ranges = with_duals(packing, gap);
      ASSERT_EQ(ranges.method, Method::kBarrier);
      ASSERT_EQ(ranges.duals.contacts.size(), packing.contact_count());
      const Verification found = verify_ranges(packing, ranges);
      EXPECT_TRUE(found.passed()) << first_message(found);
      EXPECT_THAT(found.remarks,
                  Contains(HasSubstr(std::to_string(4 * packing.contact_count()) + " intervals proven")));
    }
  }
}

TEST(VerifyRanges, TakesNothingThatMultipliersDoNotProve) {
  const Packing packing = zoo::column(9, 0.4, 0.3);
  const ForceRanges good = with_duals(packing);
  const auto refuses = [&](const char* text, auto change) {
    ForceRanges wrong = good;
    change(wrong);
    const Verification found = verify_ranges(packing, wrong);
    EXPECT_FALSE(found.passed()) << text;
    EXPECT_THAT(found.messages, Contains(HasSubstr(text)));
  };
  const double slip = 1e-3 * good.force_unit;
  refuses("contact 2 R_min: between", [&](ForceRanges& r) { r.lower(2, kMinR) += slip; });
  refuses("contact 2 R_max: between", [&](ForceRanges& r) { r.upper(2, kMaxR) -= slip; });
  refuses("contact 2 T_max: between",
          [](ForceRanges& r) { r.duals.multipliers.row(4 * 2 + kMaxT) *= 1 + 1e-3; });
  refuses("contact 2 T_min: the state that proves it violates",
          [](ForceRanges& r) { r.duals.points(4 * 2 + kMinT, 3) *= 1 + 1e-6; });
  refuses("contact 2 R_min: between", [](ForceRanges& r) {  // a state, but of another value
    r.duals.points.row(4 * 2 + kMinR) = r.duals.points.row(4 * 2 + kMaxR);
  });
  refuses("contact 2 R_min: its proof has numbers that are none",
          [](ForceRanges& r) { r.duals.multipliers(4 * 2 + kMinR, 1) = ForceRanges::kNaN; });
  refuses("/duals/bounding: it does not limit", [](ForceRanges& r) { r.duals.bounding *= -1; });
  refuses("/duals/bounding: not", [](ForceRanges& r) { r.duals.bounding.conservativeResize(5); });
}

TEST(VerifyRanges, ChecksReactions) {
  const Packing packing = zoo::disk_on_two_fixed(0.5, 0.3, 1, 2);
  const ForceRanges good = analyze(packing);
  ASSERT_EQ(good.reactions.count(), 6);
  EXPECT_TRUE(verify_ranges(packing, good).passed()) << first_message(verify_ranges(packing, good));
  const auto refuses = [&](auto change) {
    ForceRanges wrong = good;
    change(wrong.reactions);
    return !verify_ranges(packing, wrong).passed();
  };
  EXPECT_TRUE(refuses([](Reactions& r) { r.value(0, 1) += 1e-6; }));
  EXPECT_TRUE(refuses([](Reactions& r) { std::swap(r.vertex(0, 0), r.vertex(0, 1)); }));
  EXPECT_TRUE(refuses([](Reactions& r) { r.states(0, 0) *= 1.001; }));
  EXPECT_TRUE(refuses([](Reactions& r) { r.component[0] = 1; }));
  EXPECT_TRUE(refuses([](Reactions& r) { r.body[0] = 2; }));
  EXPECT_TRUE(refuses([](Reactions& r) { r.lower(0, 0) = 1; }));
  EXPECT_TRUE(refuses([](Reactions& r) { r.outcome(0, 0) = Outcome::kFailed; }));
  // A state that is admissible, but not where the sum is largest.
  EXPECT_TRUE(refuses([](Reactions& r) {
    r.vertex(0, 1) = r.vertex(0, 0);
    r.value(0, 1) = r.lower(0, 1) = r.upper(0, 1) = r.value(0, 0);
  }));
}

TEST(VerifyRanges, SaysHowManyObjectivesFailedOrAreImprecise) {
  const Packing packing = zoo::column(3, 0.3, 0.5);
  ForceRanges ranges = analyze(packing);
  EXPECT_TRUE(verify_ranges(packing, ranges).unsolved.empty());
  ranges.outcome(0, kMaxT) = Outcome::kFailed;
  ranges.vertex(0, kMaxT) = -1;
  ranges.value(0, kMaxT) = ranges.delta_T[0] = ranges.d_T[0] = ranges.T_star[0] = ForceRanges::kNaN;
  ranges.outcome(1, kMinR) = Outcome::kImprecise;
  ranges.failed = ranges.imprecise = 1;
  ranges.certified -= 2;
  const Verification found = verify_ranges(packing, ranges);
  EXPECT_THAT(found.unsolved,
              testing::ElementsAre("1 of 24 objectives imprecise", "1 of 24 objectives failed"));
}

/// The hull at the mean of the stored states; the packing has to be one whose states reach the interior.
/// Without states in the file, and where edges are closed in all states.
/// A disk without load between two walls that push the same way: no force at all. Both sides of a narrow cone
/// are tight, and their normals are nearly opposite.
TEST(VerifyRanges, AcceptsTheApexOfANarrowCone) {
  Packing packing = zoo::wedge(0.4, 0.3);
  packing.gravity.setZero();
  packing.named_force_unit = 1;
  for (Contact& contact : packing.contacts) contact.normal = {0, 1};
  for (Wall& wall : packing.walls) wall.normal = {0, 1};
  packing.contacts[0].mu = 1e-8;
  packing.contacts[1].mu = 1e6;
  const ForceRanges ranges = analyze(packing);
  EXPECT_EQ(ranges.certified, 8);
  const Verification found = verify_ranges(packing, ranges);
  EXPECT_TRUE(found.passed()) << first_message(found);
}

TEST(VerifyRanges, BlocksAndDeterminedForcesOfTheBarrierMethod) {
  int checked = 0;
  for (const Packing& packing :
       {zoo::column(6, 0.4, 0.3), zoo::two_wedges(0.4, 0.3, 0.5, 0.2), zoo::corner(0.4, 1),
        zoo::biaxial_box(3, 3, 1, 2, 0), zoo::lattice_pile(5, 0.6), zoo::disk_on_floor(0.3),
        zoo::periodic_lattice(3, 3, 0.3, 0.01), zoo::random_pile(3, 20, 0.4)}) {
    SCOPED_TRACE(checked);
    AnalyzeOptions options;
    options.method = Method::kBarrier;
    options.states.kind = StateChoice::Kind::kNone;
    const ForceRanges good = analyze(packing, options);
    if (good.status == PolytopeStatus::kEmpty) continue;
    ASSERT_EQ(good.states.rows(), 0);
    const Verification found = verify_ranges(packing, good);
    EXPECT_TRUE(found.passed()) << first_message(found);
    EXPECT_THAT(found.unchecked, Not(Contains(HasSubstr("blocks"))));
    EXPECT_THAT(found.unchecked, Not(Contains(HasSubstr("determined"))));
    ForceRanges wrong = good;
    ++wrong.blocks;
    expect_contradiction(packing, wrong, "blocks");
    wrong = good;
    wrong.determined += 2;
    expect_contradiction(packing, wrong, "determined");
    ++checked;
  }
  EXPECT_GE(checked, 6);
}

std::optional<AffineHull> hull_of(const Packing& packing, const ForceRanges& ranges) {
  const RebuiltProblem problem(packing);
  Eigen::VectorXd inside = ranges.states.colwise().mean().transpose() / ranges.force_unit;
  if (ranges.rays.rows() > 0) inside += ranges.rays.colwise().sum().transpose();
  return AffineHull::at(problem, inside);
}

TEST(AffineHull, HasTheDimensionAndTheBlocksOfThePolytope) {
  struct Case {
    Packing packing;
    int dim, blocks;
  };
  for (const Case& c :
       {Case{zoo::two_wedges(0.5, 0.3, 0.4, 0.2), 2, 2}, Case{zoo::wedge_and_corner(0.5, 0.3), 1, 1},
        Case{zoo::corner(0.5, 0.5), 0, 0}, Case{zoo::corner(0.5, 1), 1, 1},
        Case{zoo::pinched_disk(0.4), 1, 1}, Case{zoo::column(4, 0.2, 0.5), 4, 1}}) {
    SCOPED_TRACE(testing::Message() << "dimension " << c.dim << ", contacts " << c.packing.contact_count());
    const ForceRanges ranges = analyze(c.packing);
    EXPECT_EQ(ranges.dim, c.dim);
    EXPECT_EQ(ranges.blocks, c.blocks);
    const std::optional<AffineHull> hull = hull_of(c.packing, ranges);
    ASSERT_TRUE(hull);
    EXPECT_EQ(hull->dim(), c.dim);
    EXPECT_EQ(hull->blocks(), c.blocks);
    const Verification found = verify_ranges(c.packing, ranges);
    EXPECT_TRUE(found.passed()) << first_message(found);
  }
}

TEST(AffineHull, AgreesWithThePolytopesOfPiles) {
  int compared = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const Packing packing = zoo::random_pile(seed, 8, 0.5);
    const ForceRanges ranges = analyze(packing);
    if (ranges.status == PolytopeStatus::kEmpty || ranges.doubtful) continue;
    const std::optional<AffineHull> hull = hull_of(packing, ranges);
    ASSERT_TRUE(hull) << seed;
    EXPECT_LE(hull->dim(), ranges.dim);
    if (hull->dim() < ranges.dim) continue;  // the states do not reach the interior
    EXPECT_EQ(hull->blocks(), ranges.blocks) << seed;
    ++compared;
  }
  EXPECT_GT(compared, 10);
}

}  // namespace
}  // namespace indet
