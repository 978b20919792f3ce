#include "libindet/range/join_ranges.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "libindet/base/error.h"
#include "libindet/base/random.h"
#include "libindet/io/ranges_file.h"
#include "libindet/polytope/central_polytope.h"
#include "libindet/range/analyze.h"
#include "libindet/range/dealt_analysis.h"
#include "tests/support/periodic_lattice.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/zoo.h"

namespace indet {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

AnalyzeOptions by_barrier(StateChoice::Kind states = StateChoice::Kind::kNone) {
  AnalyzeOptions options;
  options.method = Method::kBarrier;
  options.states = {.kind = states, .within_limit = false};
  return options;
}

/// Contacts dealt by chance; none of the parts is empty.
std::vector<std::vector<int>> random_parts(const std::vector<int>& contacts, std::size_t count) {
  std::vector<std::vector<int>> parts(std::min(count, contacts.size()));
  Random random(3);
  for (std::size_t k = 0; k < contacts.size(); ++k)
    parts[k < parts.size() ? k : random.below(parts.size())].push_back(contacts[k]);
  return parts;
}

std::vector<ForceRanges> analyze_parts(const Packing& packing, const AnalyzeOptions& options,
                                       std::size_t count) {
  const DealtAnalysis analysis(packing, options);
  std::vector<ForceRanges> parts;
  for (const std::vector<int>& contacts : random_parts(analysis.contacts(), count))
    parts.push_back(analysis.find(contacts, 1, {}));
  return parts;
}

Digests digests_of(const Packing& packing, const ForceRanges& ranges) {
  const test::TemporaryFolder folder;
  write_ranges(folder / "r.h5", packing, ranges, {});
  return compute_digests(folder / "r.h5");
}

/// The parts are found one after the other, or last first: with their own polytope each.
void expect_same_as_whole(const Packing& packing, const AnalyzeOptions& options) {
  std::vector<ForceRanges> parts = analyze_parts(packing, options, 4);
  std::reverse(parts.begin(), parts.end());
  const ForceRanges joined = join_ranges(packing, options.contacts, parts);
  const ForceRanges whole = analyze(packing, options);
  ASSERT_EQ(whole.method, Method::kBarrier);
  EXPECT_EQ(joined.states.rows(), whole.states.rows());
  EXPECT_EQ(joined.rays.rows(), whole.rays.rows());
  const Digests of_joined = digests_of(packing, joined), of_whole = digests_of(packing, whole);
  EXPECT_EQ(of_joined.content, of_whole.content);
  EXPECT_EQ(of_joined.texts, of_whole.texts);
}

/// A pile of some disks that can be dealt, whose forces are limited, or not.
Packing pile_of(PolytopeStatus status, int count) {
  for (std::uint64_t seed = 0;; ++seed) {
    Packing pile = zoo::random_pile(seed, count, 0.4);
    const auto polytope = find_sparse_polytope(pile);
    const bool has_centre = polytope && (polytope->central || polytope->unbounded);
    if (has_centre && polytope->status == status && polytope->dim > 3) return pile;
  }
}

TEST(JoinRanges, OfAPileAreThoseOfOneAnalysis) {
  const Packing pile = pile_of(PolytopeStatus::kBounded, 25);
  expect_same_as_whole(pile, by_barrier());
  AnalyzeOptions with_all = by_barrier(StateChoice::Kind::kCanonical);
  with_all.smallest_distances = true;
  expect_same_as_whole(pile, with_all);
}

TEST(JoinRanges, OfSmallPackings) {
  for (const Packing& packing :
       {zoo::pyramid(0.8, 1, 1), zoo::corner(0.4, 0.9), zoo::wedge_and_corner(0.4, 0.3),
        zoo::two_wedges(0.4, 0.3, 0.5, 0.3), zoo::lattice_pile(4, 0.6)})
    expect_same_as_whole(packing, by_barrier(StateChoice::Kind::kCanonical));
}

/// Parts reach a state that they share by other steps, and so with other roundings.
TEST(JoinRanges, TakeOneOfSeveralRoundingsOfAState) {
  expect_same_as_whole(zoo::periodic_lattice(4, 4, 0.3, 0.02), by_barrier(StateChoice::Kind::kCanonical));
}

TEST(JoinRanges, OfSomeContactsWithStatesOfSome) {
  const Packing pile = pile_of(PolytopeStatus::kBounded, 25);
  AnalyzeOptions options = by_barrier(StateChoice::Kind::kCanonical);
  options.contacts = {.kind = ContactChoice::Kind::kList, .list = {30, 2, 3, 5, 7, 11, 13, 17, 19, 23}};
  options.states.contacts = StateChoice::Contacts::kList;
  options.states.list = {5, 2, 23};
  expect_same_as_whole(pile, options);
}

TEST(JoinRanges, KeepDualsOfTheContactsThatADrawOfAllChose) {
  const Packing pile = pile_of(PolytopeStatus::kBounded, 25);
  for (const DualChoice& duals : {DualChoice{DualChoice::Kind::kSample, 6, 5}, {DualChoice::Kind::kAll}}) {
    AnalyzeOptions options = by_barrier();
    options.duals = duals;
    expect_same_as_whole(pile, options);
  }
  AnalyzeOptions options = by_barrier();
  options.duals.kind = DualChoice::Kind::kAll;
  expect_same_as_whole(zoo::wedge_and_corner(0.4, 0.3), options);  // closed edges have a motion of their own
}

/// Such a packing is dealt where it is large; the same search serves small ones.
TEST(JoinRanges, OfForcesThatGrowWithoutLimitHaveTheRaysOfOneAnalysis) {
  const Packing pile = pile_of(PolytopeStatus::kUnbounded, 25);
  const AnalyzeOptions options = by_barrier();
  const AnalysisStart start = begin_analysis(pile, options);
  const std::vector<int> contacts = chosen_contacts({}, pile.contact_count());
  const BarrierAnalysis analysis(pile, start, contacts, CentralWidths(), options);
  std::vector<ForceRanges> parts;
  for (const std::vector<int>& part : random_parts(contacts, 4))
    parts.push_back(analysis.find(part, {}, 1, {}).value());
  const ForceRanges joined = join_ranges(pile, {}, parts);
  EXPECT_GT(joined.rays.rows(), 1);
  EXPECT_EQ(digests_of(pile, joined).content, digests_of(pile, analyze(pile, options)).content);
}

TEST(JoinRanges, ContradictionsAreTold) {
  const Packing wedge = zoo::two_wedges(0.4, 0.3, 0.5, 0.3);
  const DealtAnalysis analysis(wedge, by_barrier());
  const std::vector<ForceRanges> parts = {analysis.find({0, 1}, 1, {}), analysis.find({2}, 1, {}),
                                          analysis.find({2, 3}, 1, {})};
  const auto joining = [&](std::vector<ForceRanges> some, const ContactChoice& choice = {}) {
    return [some = std::move(some), choice, &wedge] { join_ranges(wedge, choice, some); };
  };
  EXPECT_THAT(joining({}), ThrowsMessage<InputError>(HasSubstr("no part")));
  EXPECT_THAT(joining({parts[0], parts[1]}), ThrowsMessage<InputError>("contact 3 is in no part"));
  EXPECT_THAT(joining(parts), ThrowsMessage<InputError>("contact 2 is in two parts"));
  EXPECT_THAT(joining({parts[0], parts[2]}, {.kind = ContactChoice::Kind::kList, .list = {0, 1, 2}}),
              ThrowsMessage<InputError>("contact 3 is in a part, and was not asked for"));
  AnalyzeOptions wider = by_barrier();
  wider.gap = 1e-3;
  EXPECT_THAT(joining({parts[0], DealtAnalysis(wedge, wider).find({2, 3}, 1, {})}),
              ThrowsMessage<InputError>(HasSubstr("differ in gap")));
  const Packing other = zoo::two_wedges(0.4, 0.3, 0.5, 0);
  EXPECT_THAT(joining({parts[0], DealtAnalysis(other, by_barrier()).find({2, 3}, 1, {})}),
              ThrowsMessage<InputError>(HasSubstr("differ in unknowns")));
  const Packing one = zoo::wedge(0.4, 0.3);
  EXPECT_THAT(joining({parts[0], DealtAnalysis(one, by_barrier()).find({0, 1}, 1, {})}),
              ThrowsMessage<InputError>(HasSubstr("has 2 contacts, and the packing has 4")));
}

TEST(DealtAnalysis, SaysWhatCannotBeDealt) {
  const Packing pile = pile_of(PolytopeStatus::kBounded, 25);
  const auto dealing = [](const Packing& packing, const AnalyzeOptions& options) {
    return [&packing, options] { DealtAnalysis(packing, options); };
  };
  EXPECT_THAT(dealing(pile, {}), ThrowsMessage<InputError>(HasSubstr("with --method barrier it does not")));
  AnalyzeOptions options = by_barrier();
  options.estimate = EstimateOptions();
  EXPECT_THAT(dealing(pile, options), ThrowsMessage<InputError>(HasSubstr("calibration")));
  options = by_barrier();
  options.exactness = AnalyzeOptions::Exactness::kEverywhere;
  EXPECT_THAT(dealing(pile, options), ThrowsMessage<InputError>(HasSubstr("together")));
  options = by_barrier();
  options.contacts = {.kind = ContactChoice::Kind::kSample, .sample_size = 5};
  EXPECT_THAT(dealing(pile, options), ThrowsMessage<InputError>(HasSubstr("drawn")));
  options = by_barrier(StateChoice::Kind::kCanonical);
  options.states.contacts = StateChoice::Contacts::kLargest;
  options.states.largest = 3;
  EXPECT_THAT(dealing(pile, options), ThrowsMessage<InputError>(HasSubstr("largest")));
  EXPECT_THAT(dealing(zoo::disk_on_incline(0.1, 1), by_barrier()),
              ThrowsMessage<InputError>(HasSubstr("admissible")));
  EXPECT_THAT(dealing(zoo::wedge(1.4, 0.3), by_barrier(StateChoice::Kind::kCanonical)),
              ThrowsMessage<InputError>(HasSubstr("without extremal states may do")));
  EXPECT_THAT(dealing(zoo::wedge(1.4, 0.3), by_barrier()),
              ThrowsMessage<InputError>(HasSubstr("without limit")));
}

TEST(DealtAnalysis, StopsWhenAsked) {
  const Packing pile = pile_of(PolytopeStatus::kBounded, 25);
  const DealtAnalysis analysis(pile, by_barrier());
  EXPECT_THROW(analysis.find({0, 1, 2}, 1, [](const Progress&) { return false; }), Interrupted);
}

}  // namespace
}  // namespace indet
