#include "apps/ensemble/presentation/comparison.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "apps/ensemble/presentation/paper_choices.h"
#include "apps/ensemble/presentation/samples.h"
#include "apps/ensemble/presentation/verdict.h"

namespace indet {
namespace {

/// Two packings of each protocol with one contact each, whose dimensions are as in the paper and whose mean
/// force and distances are not.
EnsembleTables some_ensemble(int disks, double mu) {
  EnsembleTables tables;
  for (const sim::Protocol protocol : sim::kSimulated) {
    for (const int seed : {0, 1}) {
      const std::size_t run = tables.runs.rows();
      tables.runs.add_rows(1);
      tables.runs.set("protocol", run, std::string(to_string(protocol)));
      tables.runs.set("seed", run, seed);
      tables.runs.set("disks", run, disks);
      tables.runs.set("lower_bound", run, 40);
      tables.runs.set("dim", run, 41 + seed);
      tables.runs.set("sliding", run, 5);
      tables.runs.set("mean_R", run, 20 + 0.1 * seed);
      tables.runs.set("r", run, 33 + 0.1 * seed);
      tables.contacts.add_rows(1);
      tables.contacts.set("run", run, static_cast<double>(run));
      tables.contacts.set("mu", run, mu);
    }
  }
  return tables;
}

const Protocols kAllOfThem = {sim::kSimulated.begin(), sim::kSimulated.end()};

std::set<std::string> verdicts(const EnsembleTables& tables) {
  std::set<std::string> result;
  for (const Comparison& row : compare_with_paper(tables)) result.insert(row.verdict);
  return result;
}

TEST(Comparison, WritesWhatIsKnownOfAnEstimate) {
  const double unknown = std::nan("");
  EXPECT_EQ(text_of({33.04, 1.36}), "33.0 ± 1.4");
  EXPECT_EQ(text_of({0.512, 0.004}, 2), "0.51 ± 0.00");
  EXPECT_EQ(text_of({33.04, unknown}), "33.0");
  EXPECT_EQ(text_of({unknown, unknown}), "–");
}

TEST(Comparison, JudgesTheCaseOfThePaper) {
  const EnsembleTables tables = some_ensemble(95, 0.3);
  EXPECT_EQ(reason_for_no_verdict(tables), "");
  EXPECT_EQ(verdicts(tables), (std::set<std::string>{kAgrees, kDiffers, kNotDecided}));
}

TEST(Comparison, OrderIsDecidedByTwoStandardErrors) {
  EXPECT_STREQ(verdict_of_order({10, 1}, {7, 1}), kAgrees);
  EXPECT_STREQ(verdict_of_order({10, 1}, {7.5, 1}), kNotDecided);
  EXPECT_STREQ(verdict_of_order({7.5, 1}, {10, 1}), kNotDecided);
  EXPECT_STREQ(verdict_of_order({7, 1}, {10, 1}), kDiffers);

  EXPECT_STREQ(verdict_about({64, 1}, 60), kAgrees);
  EXPECT_STREQ(verdict_about({75, 8}, 60), kAgrees);
  EXPECT_STREQ(verdict_about({75, 7}, 60), kDiffers);
  EXPECT_STREQ(verdict_about({33, 38.9}, 60), kNotDecided) << "an error that allows anything";
  EXPECT_STREQ(verdict_about({75, 10.1}, 60), kNotDecided) << "two errors are more than a third";
}

TEST(Comparison, AgreesOnlyWhereItCouldHaveDiffered) {
  EXPECT_STREQ(verdict({33.6, 1.3}, 33, 1.4), kAgrees);
  EXPECT_STREQ(verdict({40, 1.3}, 33, 1.4), kDiffers);
  EXPECT_STREQ(verdict({187.9, 58.7}, 75, 4), kNotDecided);
  EXPECT_STREQ(verdict({75, 12}, 75, 5), kNotDecided);
  EXPECT_STREQ(verdict({75, 11}, 75, 5), kAgrees);
}

/// Verdicts on the sliding contacts of the four families, with these numbers in the raw states of both seeds.
std::vector<std::string> sliding_verdicts(const std::array<double, 4>& raw) {
  EnsembleTables tables = some_ensemble(95, 0.3);
  for (std::size_t run = 0; run < tables.runs.rows(); ++run)
    tables.runs.set("raw_sliding", run, raw[run / 2] + 0.1 * static_cast<double>(run % 2));
  std::vector<std::string> verdicts;
  for (const Comparison& row : compare_with_paper(tables)) {
    if (row.quantity.starts_with("sliding contacts, ")) verdicts.push_back(row.verdict);
  }
  return verdicts;
}

TEST(Comparison, JudgesSlidingContactsByTheirOrderInTheRawStates) {
  using Verdicts = std::vector<std::string>;
  EXPECT_EQ(sliding_verdicts({0, 0.2, 6, 33}), (Verdicts{kAgrees, kAgrees, kAgrees, kAgrees}));
  EXPECT_EQ(sliding_verdicts({8, 17, 0, 0}), (Verdicts{kDiffers, kDiffers, kDiffers, kDiffers}));
  EXPECT_EQ(sliding_verdicts({0, 0, 20, 20.1}), (Verdicts{kAgrees, kAgrees, kNotDecided, kNotDecided}));
  // Most where it should be between.
  EXPECT_EQ(sliding_verdicts({0, 0, 33, 6}), (Verdicts{kAgrees, kAgrees, kDiffers, kDiffers}));
}

TEST(PaperChoices, EachRowIsWhole) {
  ASSERT_FALSE(paper_choices().empty());
  EXPECT_TRUE(paper_choices_origin().starts_with("bench/paper_choices.py ")) << paper_choices_origin();
  const std::set<std::string> verdicts = {kAgrees, kDiffers, kNotDecided};
  for (const PaperChoice& choice : paper_choices()) {
    EXPECT_TRUE(verdicts.contains(choice.verdict)) << choice.choice << ": " << choice.quantity;
    EXPECT_FALSE(choice.ours.empty()) << choice.choice << ": " << choice.quantity;
  }
}

TEST(PaperChoices, AreThoseOfRowsOfTheComparison) {
  for (const Comparison& row : compare_with_paper(some_ensemble(95, 0.3))) {
    if (row.quantity.starts_with("mean R, ") || row.quantity.starts_with("sliding contacts")) {
      EXPECT_FALSE(choices_of(row.quantity).empty()) << row.quantity;
    }
  }
}

TEST(Comparison, HasNoVerdictOnOtherSizes) {
  const EnsembleTables tables = some_ensemble(400, 0.3);
  EXPECT_EQ(reason_for_no_verdict(tables),
            "The paper's numbers are for N = 95 and μ = 0.3; here N = 400 and μ = 0.3.");
  EXPECT_EQ(verdicts(tables), std::set<std::string>{""});
}

TEST(Comparison, HasNoVerdictIfOnlySomePackingsAreOfThePaper) {
  EnsembleTables tables = some_ensemble(95, 0.3);
  tables.contacts.set("mu", 2, 0.5);
  EXPECT_EQ(reason_for_no_verdict(tables),
            "The paper's numbers are for N = 95 and μ = 0.3; here N = 95 and μ = 0.3 … 0.5.");
  EXPECT_EQ(verdicts(tables), std::set<std::string>{""});
}

TEST(Comparison, CountsTheWalksThatEndOtherThanExpected) {
  EnsembleTables tables = some_ensemble(95, 0.3);
  const auto row_of_walks = [&] {
    std::vector<Comparison> found;
    for (const Comparison& row : compare_with_paper(tables)) {
      if (row.paper == "about 1 %") found.push_back(row);
    }
    return found;
  };
  EXPECT_TRUE(row_of_walks().empty()) << "nobody walked";
  tables.runs.set("paper_walks", 0, 600);
  tables.runs.set("paper_failures", 0, 6);
  tables.runs.set("paper_walks", 3, 500);
  tables.runs.set("paper_failures", 3, 6);
  ASSERT_EQ(row_of_walks().size(), 1);
  EXPECT_EQ(row_of_walks().front().ours, "1.1 ± 0.1 %");
  EXPECT_EQ(row_of_walks().front().verdict, "agrees");
  tables.runs.set("paper_failures", 0, 300);
  tables.runs.set("paper_failures", 3, 250);
  EXPECT_EQ(row_of_walks().front().ours, "50.0 ± 0.0 %");
  EXPECT_EQ(row_of_walks().front().verdict, "differs");
}

TEST(Samples, SeedsWithoutAValueAreNoGroup) {
  EnsembleTables tables = some_ensemble(95, 0.3);
  EXPECT_FALSE(Samples(tables).has_paper_walk());
  EXPECT_EQ(Samples(tables).of(kAllOfThem, "paper_d_R").groups, 0);
  tables.contacts.set("paper_d_R", 3, 5.0);  // seed 1
  tables.contacts.set("paper_d_R", 5, 6.0);  // seed 1
  const Samples samples(tables);
  EXPECT_TRUE(samples.has_paper_walk());
  const GroupedValues values = samples.of(kAllOfThem, "paper_d_R");
  EXPECT_EQ(values.groups, 1);
  EXPECT_EQ(values.group[3], 0);
  EXPECT_EQ(values.group[5], 0);
  EXPECT_EQ(samples.of(kAllOfThem, "mu").groups, 2);
}

TEST(FlatTable, SumsWhatIsKnown) {
  EnsembleTables tables = some_ensemble(95, 0.3);
  EXPECT_EQ(tables.runs.sum("disks"), 8 * 95);
  tables.runs.set("samples", 3, 500);
  EXPECT_EQ(tables.runs.sum("samples"), 500);  // NaN elsewhere
}

}  // namespace
}  // namespace indet
