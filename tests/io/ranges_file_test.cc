#include "libindet/io/ranges_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <string>

#include "libindet/io/hdf5_file.h"
#include "tests/io/sample.h"
#include "tests/support/compare.h"
#include "tests/support/temporary_folder.h"

namespace indet {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// Equal, where NaN equals NaN.
template <class Left, class Right>
bool same(const Left& left, const Right& right) {
  if (left.rows() != right.rows() || left.cols() != right.cols()) return false;
  for (Eigen::Index i = 0; i < left.rows(); ++i) {
    for (Eigen::Index j = 0; j < left.cols(); ++j) {
      const auto a = left(i, j);
      const auto b = right(i, j);
      if (!(a == b || (a != a && b != b))) return false;
    }
  }
  return true;
}

void expect_same_packing(const Packing& left, const Packing& right) {
  EXPECT_EQ(left.gravity, right.gravity);
  EXPECT_EQ(left.named_force_unit, right.named_force_unit);
  EXPECT_EQ(left.origin.protocol, right.origin.protocol);
  EXPECT_EQ(left.origin.seed, right.origin.seed);
  EXPECT_EQ(left.origin.config, right.origin.config);
  ASSERT_EQ(left.disk_count(), right.disk_count());
  for (int i = 0; i < left.disk_count(); ++i) {
    const Disk& a = left[DiskId(i)];
    const Disk& b = right[DiskId(i)];
    EXPECT_EQ(a.id, b.id);
    EXPECT_EQ(a.position, b.position);
    EXPECT_EQ(a.radius, b.radius);
    EXPECT_EQ(a.mass, b.mass);
    EXPECT_EQ(a.inertia, b.inertia);
    EXPECT_EQ(a.angle, b.angle);
    EXPECT_EQ(a.velocity, b.velocity);
    EXPECT_EQ(a.angular_velocity, b.angular_velocity);
    EXPECT_EQ(a.load, b.load);
  }
  ASSERT_EQ(left.wall_count(), right.wall_count());
  for (int i = 0; i < left.wall_count(); ++i) {
    const Wall& a = left[WallId(i)];
    const Wall& b = right[WallId(i)];
    EXPECT_TRUE(a.id == b.id && a.point == b.point && a.normal == b.normal && a.name == b.name) << i;
  }
  ASSERT_EQ(left.contact_count(), right.contact_count());
  for (int i = 0; i < left.contact_count(); ++i) {
    const Contact& a = left[ContactId(i)];
    const Contact& b = right[ContactId(i)];
    EXPECT_TRUE(a.a == b.a && a.b == b.b && a.normal == b.normal && a.gap == b.gap && a.mu == b.mu) << i;
  }
  EXPECT_TRUE(same(left.simulated_forces().value(), right.simulated_forces().value()));
}

TEST(PackingFile, APackingComesBack) {
  const test::TemporaryFolder folder;
  Packing packing = test::sample_packing();
  write_packing(folder / "p.h5", packing, {});
  expect_same_packing(read_packing(folder / "p.h5"), packing);
  EXPECT_FALSE(has_ranges(open_indet_file(folder / "p.h5")));
  packing.gravity = {0, 0};
  packing.named_force_unit = 3;
  packing.walls.clear();
  packing.contacts.clear();
  write_packing(folder / "p.h5", packing, {});
  expect_same_packing(read_packing(folder / "p.h5"), packing);
}

TEST(PackingFile, ProvenanceTellsOfTheRun) {
  const test::TemporaryFolder folder;
  write_packing(folder / "p.h5", test::sample_packing(),
                {{"indet", "import"}, "threads = 2\n", {{"GLPK", "5.0"}}, {{"read", 0.5}}});
  const Hdf5File file = open_indet_file(folder / "p.h5");
  EXPECT_EQ(file.string_attribute("/provenance", "config"), "threads = 2\n");
  EXPECT_EQ(file.string_attribute("/provenance/libraries", "GLPK"), "5.0");
  EXPECT_EQ(file.string_attribute("/provenance/libraries", "HDF5"), hdf5_version());
  EXPECT_EQ(file.double_attribute("/provenance/timings", "read"), 0.5);
  EXPECT_THAT(file.string_attribute("/provenance", "created"),
              ::testing::MatchesRegex("20..-..-..T..:..:..Z"));
}

TEST(PackingFile, AnInvalidPackingIsRefused) {
  const test::TemporaryFolder folder;
  Packing packing = test::sample_packing();
  packing.contacts[3].normal = {0, 1};
  write_packing(folder / "p.h5", packing, {});
  EXPECT_THAT([&] { read_packing(folder / "p.h5"); },
              ThrowsMessage<InputError>(HasSubstr("p.h5: contact 3: the normal (0, 1) disagrees")));
}

TEST(RangesFile, EveryFieldComesBack) {
  const test::TemporaryFolder folder;
  const ForceRanges written = test::sample_ranges();
  write_ranges(folder / "r.h5", test::sample_packing(), written, {{}, "", {}, {{"write", 0.125}}});
  EXPECT_TRUE(has_ranges(open_indet_file(folder / "r.h5")));
  expect_same_packing(read_packing(folder / "r.h5"), test::sample_packing());
  const ForceRanges read = read_ranges(folder / "r.h5");
  EXPECT_TRUE(test::same_bytes(read, written));
  EXPECT_EQ(read.seconds, (std::map<std::string, double>{{"rank", 0.25}, {"ranges", 1.5}, {"write", 0.125}}));
}

TEST(RangesFile, AChoiceOfContactsComesBack) {
  const test::TemporaryFolder folder;
  ForceRanges written = test::sample_ranges();
  write_ranges(folder / "r.h5", test::sample_packing(), written, {});
  EXPECT_EQ(read_ranges(folder / "r.h5").choice, ContactChoice::Kind::kAll);
  EXPECT_EQ(read_ranges(folder / "r.h5").requested, 5);
  EXPECT_EQ(read_ranges(folder / "r.h5").method, Method::kLp);
  written.choice = ContactChoice::Kind::kSample;
  written.requested = 3;
  written.sample_seed = 12;
  written.sample_R = {1.5, 1.25, 1.75, 0.5};
  written.sample_T = {2.5, 2.25, 2.75, 0.25};
  write_ranges(folder / "r.h5", test::sample_packing(), written, {});
  const ForceRanges read = read_ranges(folder / "r.h5");
  EXPECT_TRUE(test::same_bytes(read, written));
  written.requested = 6;
  write_ranges(folder / "r.h5", test::sample_packing(), written, {});
  EXPECT_THAT([&] { read_ranges(folder / "r.h5"); },
              ThrowsMessage<Hdf5ReadError>(HasSubstr("/ranges@requested: 6 of 5 contacts")));
}

TEST(RangesFile, HowContactsWereDrawnComesBack) {
  const test::TemporaryFolder folder;
  ForceRanges written = test::sample_ranges();
  written.choice = ContactChoice::Kind::kSample;
  written.requested = 3;
  written.draws = 4;
  written.weight.setLinSpaced(5, 3, 7);
  written.drawn.setZero(5);
  written.drawn.head(3) << 1, 2, 1;
  written.centre.setConstant(5, 2, 1.5);
  written.width.setConstant(5, 2, 0.75);
  for (const DrawEstimator estimator : kDrawEstimators) {
    written.estimator = estimator;
    write_ranges(folder / "r.h5", test::sample_packing(), written, {});
    EXPECT_TRUE(test::same_bytes(read_ranges(folder / "r.h5"), written));
  }
  ++written.drawn[0];
  write_ranges(folder / "r.h5", test::sample_packing(), written, {});
  EXPECT_THAT([&] { read_ranges(folder / "r.h5"); },
              ThrowsMessage<Hdf5ReadError>(HasSubstr("/ranges/drawn: does not go with the draws")));
}

TEST(RangesFile, EstimatesComeBack) {
  const test::TemporaryFolder folder;
  ForceRanges written = test::sample_ranges();
  written.choice = ContactChoice::Kind::kCalibration;
  written.requested = 2;
  written.sample_seed = 3;
  written.calibration = 2;
  written.coverage = 0.95;
  written.calibrates.setZero(5);
  written.calibrates.head(2).setOnes();
  written.centre.setConstant(5, 2, 1.5);
  written.width.setConstant(5, 2, 0.75);
  double number = 0.5;
  for (DeltaEstimates* part : {&written.estimated_R, &written.estimated_T}) {
    for (Eigen::VectorXd* values : {&part->estimate, &part->low, &part->high})
      values->setLinSpaced(5, number, number + 4), number *= 2;
  }
  written.outcome.row(4).setConstant(Outcome::kEstimate);
  write_ranges(folder / "r.h5", test::sample_packing(), written, {});
  EXPECT_TRUE(test::same_bytes(read_ranges(folder / "r.h5"), written));
  written.estimated_T.low.resize(0);
  write_ranges(folder / "r.h5", test::sample_packing(), written, {});
  EXPECT_THAT([&] { read_ranges(folder / "r.h5"); },
              ThrowsMessage<Hdf5ReadError>(HasSubstr("/ranges@calibration: does not go with the estimates")));
}

TEST(RangesFile, WhatThePaperCountsComesBack) {
  const test::TemporaryFolder folder;
  ForceRanges written = test::sample_ranges();
  written.method = Method::kPivotingPaper;
  written.paper_options = {NeighbourRule::kRandom, WalkStart::kMinimum, 17};
  std::int64_t number = 1;
  for (std::int64_t& count : written.paper.starts) count = number++;
  for (std::int64_t& count : written.paper.walks) count = number++;
  written.paper.sliding_left = number++;
  written.paper.points = number++;
  written.paper.unexpected = number++;
  written.paper.neighbours = number++;
  write_ranges(folder / "r.h5", test::sample_packing(), written, {});
  const ForceRanges read = read_ranges(folder / "r.h5");
  EXPECT_TRUE(test::same_bytes(read, written));
}

TEST(RangesFile, AnEmptyPolytopeKeepsItsMotion) {
  const test::TemporaryFolder folder;
  ForceRanges written = test::sample_ranges();
  written.status = PolytopeStatus::kEmpty;
  written.dim = -1;
  written.rays.resize(0, 10);
  written.ray.setConstant(-1);
  written.motion.resize(3, 3);
  written.motion << 1, 2, 3, 4, 5, 6, 7, 8, 9;
  written.wall_motion.resize(2, 2);
  written.wall_motion << 1, 2, 3, 4;
  written.states.resize(0, 10);
  written.norm.resize(0);
  written.active.resize(0, 0);
  written.vertex.setConstant(-1);
  written.largest_norm = -1;
  write_ranges(folder / "r.h5", test::sample_packing(), written, {});
  EXPECT_TRUE(test::same_bytes(read_ranges(folder / "r.h5"), written));
}

TEST(RangesFile, PointersToNoStateAreRefused) {
  const test::TemporaryFolder folder;
  ForceRanges ranges = test::sample_ranges();
  ranges.vertex(1, 2) = 7;
  write_ranges(folder / "r.h5", test::sample_packing(), ranges, {});
  EXPECT_THAT([&] { read_ranges(folder / "r.h5"); },
              ThrowsMessage<InputError>(HasSubstr("/ranges/vertex: points to state 7, but there are 7")));
}

TEST(RangesFile, ReactionsOfNoBodyAreRefused) {
  const test::TemporaryFolder folder;
  const auto refuses = [&](const char* reason, auto change) {
    ForceRanges ranges = test::sample_ranges();
    change(ranges.reactions);
    write_ranges(folder / "r.h5", test::sample_packing(), ranges, {});
    EXPECT_THAT([&] { read_ranges(folder / "r.h5"); }, ThrowsMessage<InputError>(HasSubstr(reason)));
  };
  refuses("/reactions/vertex: points to state 3, but there are 3", [](Reactions& r) { r.vertex(1, 1) = 3; });
  refuses("/reactions/ray: points to ray 1, but there are 1", [](Reactions& r) { r.ray(0, 0) = 1; });
  refuses("/reactions/body: there is no body -3", [](Reactions& r) { r.body[3] = -3; });
  refuses("/reactions/component: there is no component 2 of body -2",
          [](Reactions& r) { r.component[2] = 2; });
  refuses("/reactions: some of its tables are missing", [](Reactions& r) { r.ray.resize(0, 2); });
}

TEST(RangesFile, DualsThatAreNotWholeAreRefused) {
  const test::TemporaryFolder folder;
  const auto refuses = [&](const char* reason, auto change) {
    ForceRanges ranges = test::sample_ranges();
    ranges.duals = test::sample_duals();
    change(ranges.duals);
    write_ranges(folder / "r.h5", test::sample_packing(), ranges, {});
    EXPECT_THAT([&] { read_ranges(folder / "r.h5"); }, ThrowsMessage<InputError>(HasSubstr(reason)));
  };
  refuses("/duals/contacts: is no ascending list", [](Duals& d) { d.contacts[1] = 1; });
  refuses("/duals/contacts: is no ascending list", [](Duals& d) { d.contacts[1] = 5; });
  refuses("/duals: has not four values", [](Duals& d) {
    d.points.conservativeResize(7, 10);
    d.multipliers.conservativeResize(7, 16);
  });
  refuses("/duals/bounding: has not 16 entries", [](Duals& d) {
    d.bounding.conservativeResize(15);
    d.multipliers.conservativeResize(8, 15);
  });
}

TEST(RangesFile, SmallestDistancesAreAllThereOrNone) {
  const test::TemporaryFolder folder;
  ForceRanges ranges = test::sample_ranges();
  ranges.smallest = test::sample_distances();
  write_ranges(folder / "r.h5", test::sample_packing(), ranges, {});
  EXPECT_TRUE(test::same_bytes(read_ranges(folder / "r.h5"), ranges));
  ranges.smallest.d_T.resize(0);
  write_ranges(folder / "r.h5", test::sample_packing(), ranges, {});
  EXPECT_THAT([&] { read_ranges(folder / "r.h5"); },
              ThrowsMessage<InputError>(HasSubstr("/ranges/d_min_outcome: does not go with d_R_min")));
}

TEST(RangesFile, AFileWithoutRangesSaysSo) {
  const test::TemporaryFolder folder;
  write_packing(folder / "p.h5", test::sample_packing(), {});
  EXPECT_THAT([&] { read_ranges(folder / "p.h5"); }, ThrowsMessage<InputError>(HasSubstr("indet analyze")));
}

TEST(RangesFile, DigestsMatchAndIgnoreProvenance) {
  const test::TemporaryFolder folder;
  write_ranges(folder / "r.h5", test::sample_packing(), test::sample_ranges(), {});
  const Digests first = compute_digests(folder / "r.h5");
  EXPECT_TRUE(first.match());
  EXPECT_EQ(first.ranges.size(), 64);
  ForceRanges other = test::sample_ranges();
  other.solves = 99;
  other.formulation = "dual";
  other.seconds["ranges"] = 3;
  write_ranges(folder / "r.h5", test::sample_packing(), other, {{"indet", "-j2"}, "threads = 2", {}, {}});
  const Digests second = compute_digests(folder / "r.h5");
  EXPECT_EQ(second.content, first.content);
  EXPECT_EQ(second.ranges, first.ranges);
  other.delta_T[4] = std::nextafter(other.delta_T[4], 100);
  write_ranges(folder / "r.h5", test::sample_packing(), other, {});
  EXPECT_NE(compute_digests(folder / "r.h5").ranges, first.ranges);
}

TEST(RangesFile, ForeignAndUnfinishedFilesAreRefused) {
  const test::TemporaryFolder folder;
  {
    Hdf5File file = Hdf5File::create(folder / "other.h5");
    file.make_group("/data");
    file.commit();
  }
  EXPECT_THAT([&] { read_packing(folder / "other.h5"); },
              ThrowsMessage<InputError>(HasSubstr("is an HDF5 file, but not one of indet")));
  {
    Hdf5File file = Hdf5File::create(folder / "half.h5");
    write_header(file);
    file.commit();
  }
  EXPECT_THAT([&] { read_packing(folder / "half.h5"); },
              ThrowsMessage<InputError>(HasSubstr("was not written to its end")));
}

}  // namespace
}  // namespace indet
