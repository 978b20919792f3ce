#include "libindet/range/barrier_ranges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "libindet/base/error.h"
#include "libindet/polytope/central_polytope.h"
#include "libindet/range/analysis_start.h"
#include "libindet/range/analyze.h"
#include "libindet/range/enclosure.h"
#include "tests/support/body_variants.h"
#include "tests/support/compare.h"
#include "tests/support/periodic_lattice.h"
#include "tests/support/zoo.h"

namespace indet {
namespace {

ForceRanges ranges_by(Method method, const Packing& packing, double gap = 1e-6, int threads = 1) {
  AnalyzeOptions options;
  options.method = method;
  options.gap = gap;
  options.threads = threads;
  options.states.kind = StateChoice::Kind::kNone;
  return analyze(packing, options);
}

/// Intervals of the same values meet, and are as narrow as asked for.
void expect_intervals_meet(const ForceRanges& lp, const ForceRanges& barrier) {
  ASSERT_EQ(lp.status, barrier.status);
  EXPECT_EQ(lp.dim, barrier.dim);
  EXPECT_EQ(lp.rank, barrier.rank);
  EXPECT_EQ(lp.objectives, barrier.objectives);
  EXPECT_EQ(lp.blocks, barrier.blocks) << barrier.blocks_reason;
  EXPECT_EQ(lp.determined, barrier.determined);
  if (lp.doubtful) return;
  EXPECT_FALSE(barrier.doubtful);
  EXPECT_EQ(barrier.certified, lp.certified);
  for (Eigen::Index i = 0; i < lp.value.rows(); ++i) {
    for (int column = 0; column < 4; ++column) {
      SCOPED_TRACE("contact " + std::to_string(i) + ", " + to_string(static_cast<Column>(column)));
      if (!std::isfinite(lp.value(i, column))) {
        EXPECT_EQ(lp.outcome(i, column), barrier.outcome(i, column));
        continue;
      }
      EXPECT_LE(barrier.lower(i, column), lp.upper(i, column));
      EXPECT_GE(barrier.upper(i, column), lp.lower(i, column));
      if (column == kMinR) {
        EXPECT_GE(lp.lower(i, column), std::min(0.0, lp.value(i, column)));
        EXPECT_GE(barrier.lower(i, column), std::min(0.0, barrier.value(i, column)));
      }
      if (barrier.method != Method::kBarrier) continue;
      EXPECT_EQ(barrier.outcome(i, column), Outcome::kEnclosed);
      EXPECT_LT(barrier.vertex(i, column), 0);
      const double size = std::max(1.0, std::abs(barrier.value(i, column)) / barrier.force_unit);
      EXPECT_LE((barrier.upper(i, column) - barrier.lower(i, column)) / barrier.force_unit,
                barrier.gap * size);
    }
  }
  ASSERT_EQ(lp.reactions.count(), barrier.reactions.count());
  for (Eigen::Index k = 0; k < lp.reactions.count(); ++k) {
    for (const int end : {0, 1}) {
      if (!std::isfinite(lp.reactions.value(k, end))) continue;
      EXPECT_LE(barrier.reactions.lower(k, end), lp.reactions.upper(k, end));
      EXPECT_GE(barrier.reactions.upper(k, end), lp.reactions.lower(k, end));
    }
  }
}

/// Bounded, unbounded, empty, a point; with and without friction; with closed edges.
std::vector<Packing> small_packings() {
  return {zoo::wedge(0.4, 0.3),
          zoo::wedge(1.4, 0.3),
          zoo::disk_on_floor(0.3),
          zoo::disk_on_incline(0.1, 1),
          zoo::pyramid(0.8, 0.1, 1),
          zoo::pyramid(0.8, 1, 0.1),
          zoo::pyramid(0.8, 1, 1),
          zoo::column(9, 0.4, 0.3),
          zoo::frictionless_column(5, 0.4),
          zoo::pinched_disk(0.3),
          zoo::two_wedges(0.4, 0.3, 1.4, 0.3),
          zoo::corner(0.4, 1),
          zoo::corner(0.4, 0.9),
          zoo::wedge_and_corner(0.4, 0.3),
          zoo::wedge_and_loose_disk(0.4, 0.3, 1),
          zoo::lattice_pile(5, 0.6),
          zoo::lattice_pile(5, 0.3)};
}

/// A pile whose forces are limited.
Packing bounded_pile() {
  for (std::uint64_t seed = 0;; ++seed) {
    Packing pile = zoo::random_pile(seed, 25, 0.4);
    const ForceRanges ranges = ranges_by(Method::kBarrier, pile, 0.1);
    if (ranges.status == PolytopeStatus::kBounded && ranges.dim > 3) return pile;
  }
}

TEST(BarrierRanges, AgreeWithLinearProgramsInTheZoo) {
  int found = 0;
  for (const Packing& packing : small_packings()) {
    SCOPED_TRACE(found);
    const ForceRanges barrier = ranges_by(Method::kBarrier, packing);
    expect_intervals_meet(ranges_by(Method::kLp, packing), barrier);
    found += barrier.method == Method::kBarrier ? 1 : 0;
  }
  EXPECT_GE(found, 10);
}

/// One packing far at the right of the other.
Packing side_by_side(const Packing& left, Packing right) {
  const auto disks = left.disk_count();
  const auto walls = left.wall_count();
  Packing both = left;
  for (Disk& disk : right.disks) disk.position.x() += 1000;
  for (Wall& wall : right.walls) wall.point.x() += 1000;
  for (Contact& contact : right.contacts) {
    contact.a = DiskId(contact.a.value() + disks);
    contact.b = contact.b.is_wall() ? Body::wall(WallId(contact.b.wall_id().value() + walls))
                                    : Body::disk(DiskId(contact.b.disk_id().value() + disks));
  }
  both.disks.insert(both.disks.end(), right.disks.begin(), right.disks.end());
  both.walls.insert(both.walls.end(), right.walls.begin(), right.walls.end());
  both.contacts.insert(both.contacts.end(), right.contacts.begin(), right.contacts.end());
  return both;
}

/// Rows and columns of a frictionless array share their disks, and piles their floor.
TEST(BarrierRanges, TellBlocksAndDeterminedForces) {
  std::vector<Packing> packings{zoo::biaxial_box(3, 4, 1, 2, 0),
                                zoo::biaxial_box(3, 3, 1, 2, 0.3),
                                zoo::disks_between_plates(5, 2, 0.3),
                                zoo::rack(2),
                                zoo::frictionless_column(40, 0.5),
                                zoo::periodic_lattice(3, 3, 0.3, 0.01),
                                zoo::periodic_lattice(4, 3, 0, 0.01),
                                side_by_side(zoo::column(4, 0.4, 0.3), zoo::column(3, 0.2, 0.3)),
                                side_by_side(zoo::lattice_pile(4, 0.6), zoo::frictionless_column(4, 0.4))};
  for (const double mu : {0.4, -1.0}) {
    Packing piles = zoo::column(3, 0.4, 0.3);
    int count = 1;
    for (std::uint64_t seed = 0; count < 5; ++seed) {
      const Packing pile = zoo::random_pile(seed, 12, mu);
      if (find_force_polytope(pile).status != PolytopeStatus::kBounded) continue;
      piles = side_by_side(piles, pile);
      ++count;
    }
    packings.push_back(std::move(piles));
  }
  std::int64_t found = 0, most_blocks = 0, determined = 0;
  for (std::size_t k = 0; k < packings.size(); ++k) {
    SCOPED_TRACE(k);
    const ForceRanges barrier = ranges_by(Method::kBarrier, packings[k]);
    expect_intervals_meet(ranges_by(Method::kLp, packings[k]), barrier);
    if (barrier.method != Method::kBarrier) continue;
    ++found;
    most_blocks = std::max<std::int64_t>(most_blocks, barrier.blocks);
    determined += barrier.determined;
  }
  EXPECT_GE(found, 8);
  EXPECT_GE(most_blocks, 5);
  EXPECT_GT(determined, 20);
}

TEST(BarrierRanges, AgreeWithLinearProgramsInPiles) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    const Packing packing = zoo::random_pile(seed, 4 + static_cast<int>(seed), seed % 3 == 0 ? -1 : 0.4);
    expect_intervals_meet(ranges_by(Method::kLp, packing), ranges_by(Method::kBarrier, packing));
  }
}

TEST(BarrierRanges, AgreeWithLinearProgramsWhereForcesAreUnbounded) {
  int found = 0, infinite = 0, limited = 0;
  for (std::uint64_t seed = 0; seed < 18; ++seed) {
    SCOPED_TRACE(seed);
    const Packing packing = zoo::random_pile(seed, 4 + static_cast<int>(seed), 1.5);
    const ForceRanges barrier = ranges_by(Method::kBarrier, packing);
    if (barrier.status != PolytopeStatus::kUnbounded) continue;
    expect_intervals_meet(ranges_by(Method::kLp, packing), barrier);
    found += barrier.method == Method::kBarrier ? 1 : 0;
    for (Eigen::Index i = 0; i < barrier.value.rows(); ++i) {
      for (int column = 0; column < 4; ++column) {
        if (!std::isinf(barrier.value(i, column))) {
          ++limited;
          continue;
        }
        ++infinite;
        const Eigen::VectorXd ray = barrier.rays.row(barrier.ray(i, column));
        EXPECT_TRUE(test::is_recession_ray(packing, ray, 1e-12));
        const double growth = ray[2 * i + (column >= kMinT ? 1 : 0)];
        EXPECT_GT(column == kMaxR || column == kMaxT ? growth : -growth, 0);
      }
    }
  }
  EXPECT_GE(found, 8);
  EXPECT_GT(infinite, 300);
  EXPECT_GT(limited, 150);
}

TEST(BarrierRanges, AreAsNarrowAsAskedFor) {
  const Packing packing = bounded_pile();
  const ForceRanges lp = ranges_by(Method::kLp, packing);
  for (const double gap : {1e-1, 1e-3, 1e-8}) {
    SCOPED_TRACE(gap);
    const ForceRanges barrier = ranges_by(Method::kBarrier, packing, gap);
    EXPECT_EQ(barrier.gap, gap);
    EXPECT_EQ(barrier.enclosed, barrier.objectives);
    expect_intervals_meet(lp, barrier);
  }
}

TEST(BarrierRanges, DoNotDependOnTheNumberOfThreads) {
  for (const Packing& packing : {bounded_pile(), zoo::random_pile(38, 42, 1.5)}) {
    const ForceRanges one = ranges_by(Method::kBarrier, packing);
    ASSERT_EQ(one.method, Method::kBarrier);
    for (const int threads : {2, 3}) {
      const ForceRanges several = ranges_by(Method::kBarrier, packing, 1e-6, threads);
      EXPECT_TRUE((one.lower == several.lower).all());
      EXPECT_TRUE((one.upper == several.upper).all());
      EXPECT_TRUE((one.ray == several.ray).all());
      EXPECT_TRUE(one.rays == several.rays);
      EXPECT_EQ(one.pivots, several.pivots);
    }
  }
}

ForceRanges with_states(Method method, const Packing& packing, int threads = 1) {
  AnalyzeOptions options;
  options.method = method;
  options.threads = threads;
  options.states.within_limit = false;
  return analyze(packing, options);
}

/// The same canonical states, by the same half-planes. Returns how many values have none.
int expect_same_states(const ForceRanges& lp, const ForceRanges& barrier) {
  EXPECT_EQ(barrier.certified, lp.certified);
  int without = 0;
  for (Eigen::Index i = 0; i < lp.value.rows(); ++i) {
    for (int column = 0; column < 4; ++column) {
      SCOPED_TRACE("contact " + std::to_string(i) + ", " + to_string(static_cast<Column>(column)));
      const int row = barrier.vertex(i, column);
      if (row < 0) {
        ++without;
        continue;
      }
      EXPECT_EQ(barrier.outcome(i, column), Outcome::kOptimal);
      EXPECT_NEAR(barrier.value(i, column), lp.value(i, column), 1e-9 * lp.force_unit);
      EXPECT_LE(barrier.lower(i, column), barrier.value(i, column));
      EXPECT_GE(barrier.upper(i, column), barrier.value(i, column));
      const Eigen::VectorXd known = lp.states.row(lp.vertex(i, column));
      const Eigen::VectorXd found = barrier.states.row(row);
      EXPECT_LE((known - found).norm(), 1e-9 * known.norm());
      EXPECT_EQ(barrier.active.cols(), barrier.dim);
    }
  }
  return without;
}

TEST(BarrierRanges, HaveTheCanonicalStatesOfLinearPrograms) {
  int values = 0;
  int without = 0;
  std::vector<Packing> packings = small_packings();
  for (std::uint64_t seed = 0; seed < 12; ++seed)
    packings.push_back(zoo::random_pile(seed, 4 + 2 * static_cast<int>(seed), seed % 3 == 0 ? -1 : 0.4));
  for (std::size_t k = 0; k < packings.size(); ++k) {
    SCOPED_TRACE(k);
    const ForceRanges barrier = with_states(Method::kBarrier, packings[k]);
    if (barrier.method != Method::kBarrier || barrier.status == PolytopeStatus::kEmpty) continue;
    values += static_cast<int>(barrier.objectives);
    without += expect_same_states(with_states(Method::kLp, packings[k]), barrier);
  }
  EXPECT_GT(values, 400);
  EXPECT_LE(without, values / 200);
}

TEST(BarrierRanges, KeepTheStatesThatAreAskedFor) {
  const Packing packing = bounded_pile();
  AnalyzeOptions options;
  options.method = Method::kBarrier;
  EXPECT_EQ(analyze(packing, options).states.rows(), 0);  // intervals are asked for
  options.states.contacts = StateChoice::Contacts::kLargest;
  options.states.largest = 2;
  const ForceRanges ranges = analyze(packing, options);
  EXPECT_EQ(ranges.state_contacts.size(), 2);
  EXPECT_GT(ranges.states.rows(), 0);
  EXPECT_LE(ranges.states.rows(), 8);
  EXPECT_EQ(ranges.d_R.array().isFinite().count(), 2);
  const ForceRanges all = with_states(Method::kBarrier, packing);
  for (const int contact : ranges.state_contacts) EXPECT_EQ(ranges.d_R[contact], all.d_R[contact]);
  const ForceRanges threads = with_states(Method::kBarrier, packing, 3);
  EXPECT_TRUE(all.states == threads.states);
  EXPECT_TRUE((all.vertex == threads.vertex).all());
  options.states.kind = StateChoice::Kind::kSolver;
  options.states.within_limit = false;
  EXPECT_THROW(analyze(packing, options), InputError);
}

TEST(Enclosures, ByTheCentreAgreeWithThoseByARightInverse) {
  int found = 0;
  std::vector<Packing> packings = small_packings();
  packings.push_back(bounded_pile());
  for (const Packing& packing : packings) {
    SCOPED_TRACE(found);
    ForcePolytope polytope = find_force_polytope(packing);
    if (polytope.status != PolytopeStatus::kBounded) continue;
    std::vector<int> contacts(packing.contacts.size());
    std::iota(contacts.begin(), contacts.end(), 0);
    const Extrema extrema = find_extrema(packing, polytope, contacts, {}, {});
    const Enclosures dense = enclose_values(polytope, extrema);
    ASSERT_TRUE(add_centre(polytope));
    const Enclosures central = enclose_values(polytope, extrema);
    ++found;
    EXPECT_EQ(central.proven, dense.proven);
    for (Eigen::Index k = 0; k < extrema.value.size(); ++k) {
      const double value = extrema.value.data()[k];
      const double lower = central.lower.data()[k], upper = central.upper.data()[k];
      EXPECT_LE(lower, value);
      EXPECT_GE(upper, value);
      EXPECT_LE(upper - lower, 1e-11 * packing.force_unit());
      EXPECT_LE(lower, dense.upper.data()[k]);
      EXPECT_GE(upper, dense.lower.data()[k]);
      const double sensitivity = dense.sensitivity.value.data()[k];
      EXPECT_TRUE(test::near(sensitivity, central.sensitivity.value.data()[k], 1e-10));
    }
  }
  EXPECT_GE(found, 5);
}

TEST(BarrierRanges, StopWhenAsked) {
  AnalyzeOptions options;
  options.method = Method::kBarrier;
  options.progress = [](const Progress& progress) { return progress.done == 0; };
  EXPECT_THROW(analyze(bounded_pile(), options), Interrupted);
}

TEST(MethodChoice, TakesTheBarrierMethodForLargePackings) {
  using Kind = StateChoice::Kind;
  const auto method_for = [](int contacts, Kind kind, bool within_limit = true) {
    return choose_method(contacts, {.kind = kind, .within_limit = within_limit}).method;
  };
  EXPECT_EQ(method_for(100, Kind::kNone), Method::kLp);
  EXPECT_EQ(method_for(300, Kind::kNone), Method::kBarrier);
  EXPECT_EQ(method_for(300, Kind::kCanonical), Method::kLp);
  EXPECT_EQ(method_for(10000, Kind::kCanonical), Method::kBarrier);
  EXPECT_EQ(method_for(10000, Kind::kSolver), Method::kBarrier);
  EXPECT_EQ(method_for(10000, Kind::kSolver, false), Method::kLp);
  EXPECT_FALSE(choose_method(10000, {}).reason.empty());
}

TEST(MethodChoice, FallsBackOnLinearProgramsWhereALimitIsExactAlone) {
  // T = 1/2 in every state, for the torques of two contacts at each of which both edges are unlimited.
  const ForceRanges ranges = ranges_by(Method::kBarrier, zoo::pinched_disk(0.3));
  EXPECT_EQ(ranges.status, PolytopeStatus::kUnbounded);
  EXPECT_EQ(ranges.method, Method::kLp);
  EXPECT_NE(ranges.reason.find("unbounded"), std::string::npos);
}

}  // namespace
}  // namespace indet
