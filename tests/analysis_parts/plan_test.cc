#include "apps/analysis_parts/plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>
#include <set>
#include <string>

#include "apps/analysis_parts/folder.h"
#include "apps/analysis_parts/run.h"
#include "libindet/base/error.h"
#include "tests/support/temporary_folder.h"

namespace indet {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;

const std::string kPacking(64, 'a');

AnalyzeOptions by_barrier() {
  AnalyzeOptions options;
  options.method = Method::kBarrier;
  return options;
}

AnalysisPlan plan_of(int contacts, const AnalyzeOptions& options = by_barrier()) {
  return make_analysis_plan(kPacking, contacts, options, {});
}

TEST(AnalysisPlan, ListsOfNumbersReadAsTheyWereWritten) {
  EXPECT_EQ(to_list({3, 7, 12, 13, 14}), "3,7,12-14");
  EXPECT_EQ(to_list({}), "");
  EXPECT_THAT(from_list("3,7,12-14"), ElementsAre(3, 7, 12, 13, 14));
  for (const char* wrong :
       {"", "-1", "1,", ",1", "1-", "2-1", "1,1", "3,2", "1x", "1-2-3", "1 2", "99999999999", "0-2000000000"})
    EXPECT_THAT(from_list(wrong), IsEmpty()) << wrong;
}

TEST(AnalysisPlan, ChunksHoldEachContactOnce) {
  for (const int contacts : {1, 16, 17, 340, 1000, 2760}) {
    std::vector<int> all;
    for (const Chunk& chunk : plan_of(contacts).chunks)
      all.insert(all.end(), chunk.contacts.begin(), chunk.contacts.end());
    std::vector<int> expected(static_cast<std::size_t>(contacts));
    std::iota(expected.begin(), expected.end(), 0);
    EXPECT_EQ(all, expected);
  }
  AnalyzeOptions options = by_barrier();
  options.contacts = {.kind = ContactChoice::Kind::kList, .list = {40, 2, 3}};
  const AnalysisPlan plan = plan_of(50, options);
  ASSERT_EQ(plan.chunks.size(), 1);
  EXPECT_EQ(plan.chunks[0].name, "contacts-0002-0040");
  EXPECT_THAT(plan.chunks[0].contacts, ElementsAre(2, 3, 40));
}

TEST(AnalysisPlan, SharesHoldEachChunkOnceAndCostAboutTheSame) {
  const AnalysisPlan plan = plan_of(2760);
  std::multiset<std::string> names;
  for (int number = 1; number <= 8; ++number) {
    for (const Chunk& chunk : chunks_of(plan, {number, 8})) names.insert(chunk.name);
  }
  EXPECT_EQ(names.size(), plan.chunks.size());
  EXPECT_EQ(std::set(names.begin(), names.end()).size(), plan.chunks.size());
  for (const double cost : costs_of_shares(dealt_costs(plan), 8))
    EXPECT_NEAR(cost, 63.0 / 8, 2);  // seconds, as measured
}

TEST(AnalysisPlan, HashTellsWhatResultsDependOn) {
  const std::string hash = plan_of(340).hash();
  EXPECT_EQ(plan_of(340).hash(), hash);
  AnalyzeOptions threads = by_barrier();
  threads.threads = 5;
  EXPECT_EQ(plan_of(340, threads).hash(), hash);
  const auto changed = [&](auto change) {
    AnalyzeOptions options = by_barrier();
    change(options);
    return plan_of(340, options).hash();
  };
  const std::set<std::string> others = {
      changed([](AnalyzeOptions& o) { o.gap = 1e-7; }),
      changed([](AnalyzeOptions& o) { o.reactions = false; }),
      changed([](AnalyzeOptions& o) { o.smallest_distances = true; }),
      changed([](AnalyzeOptions& o) { o.states.within_limit = false; }),
      changed([](AnalyzeOptions& o) { o.duals.kind = DualChoice::Kind::kAll; }),
      changed([](AnalyzeOptions& o) {
        o.duals = {DualChoice::Kind::kSample, 5, 1};
      }),
      changed([](AnalyzeOptions& o) {
        o.duals = {DualChoice::Kind::kSample, 5, 2};
      }),
      changed([](AnalyzeOptions& o) { o.contacts = {.kind = ContactChoice::Kind::kList, .list = {1}}; }),
      make_analysis_plan(std::string(64, 'b'), 340, by_barrier(), {}).hash(),
      make_analysis_plan(kPacking, 340, by_barrier(), {"R=known±1%"}).hash(),
      hash};
  EXPECT_EQ(others.size(), 11);
}

TEST(AnalysisPlan, ComesBackFromItsFolder) {
  const test::TemporaryFolder folder;
  EXPECT_FALSE(has_analysis_plan(folder.path()));
  AnalyzeOptions some = by_barrier();
  some.contacts = {.kind = ContactChoice::Kind::kList, .list = {1, 2, 3, 30}};
  for (const AnalyzeOptions& options : {by_barrier(), some}) {
    const AnalysisPlan plan = make_analysis_plan(kPacking, 340, options, {"R=known±1%", "a \"quoted\" one"});
    write_analysis_plan(folder.path(), plan);
    const AnalysisPlan back = read_analysis_plan(folder.path());
    EXPECT_EQ(back.hash(), plan.hash());
    EXPECT_EQ(back.contacts.kind, plan.contacts.kind);
    EXPECT_EQ(back.contacts.list, plan.contacts.list);
    ASSERT_EQ(back.chunks.size(), plan.chunks.size());
    EXPECT_EQ(back.chunks.back().name, plan.chunks.back().name);
    EXPECT_NEAR(back.chunks.back().cost, plan.chunks.back().cost, 1e-3);
  }
}

TEST(AnalysisPlan, RefusesWhatIsNone) {
  const test::TemporaryFolder folder;
  const auto reading = [&](const std::string& text) {
    folder.write("analysis.toml", text);
    return [&] { read_analysis_plan(folder.path()); };
  };
  EXPECT_THAT([&] { read_analysis_plan(folder.path()); },
              ThrowsMessage<InputError>(HasSubstr("has no analysis.toml")));
  EXPECT_THAT(reading("packing = "), ThrowsMessage<InputError>(HasSubstr("analysis.toml:1: ")));
  EXPECT_THAT(reading(""), ThrowsMessage<InputError>(HasSubstr("names no packing")));
  const std::string packing = "packing = \"" + kPacking + "\"\n";
  EXPECT_THAT(reading(packing), ThrowsMessage<InputError>(HasSubstr("all contacts or of a list")));
  EXPECT_THAT(reading(packing + "contacts = \"all\""),
              ThrowsMessage<InputError>(HasSubstr("lists no parts")));
  for (const char* chunk : {"chunk = [1]", "[[chunk]]\nname = \"../x\"\ncontacts = \"1\"",
                            "[[chunk]]\ncontacts = \"1\"", "[[chunk]]\nname = \"a\"\ncontacts = \"2-1\""})
    EXPECT_THAT(reading(packing + "contacts = \"all\"\n" + chunk),
                ThrowsMessage<InputError>(HasSubstr("a part ")));
}

}  // namespace
}  // namespace indet
