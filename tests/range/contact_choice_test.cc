#include "indet/range/contact_choice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "indet/base/random.h"

namespace indet {
namespace {

TEST(ContactChoice, ListsAreSortedAndDistinct) {
  ContactChoice choice;
  EXPECT_EQ(chosen_contacts(choice, 3), (std::vector<int>{0, 1, 2}));
  choice.kind = ContactChoice::Kind::kList;
  choice.list = {4, 1, 4, 0};
  EXPECT_EQ(chosen_contacts(choice, 9), (std::vector<int>{0, 1, 4}));
}

TEST(ContactChoice, SamplesDrawEveryContactEquallyOften) {
  constexpr int kContacts = 10;
  constexpr int kDraws = 20000;
  std::vector<int> count(kContacts, 0);
  for (int seed = 0; seed < kDraws; ++seed) {
    const ContactChoice choice{ContactChoice::Kind::kSample, 3, static_cast<std::uint64_t>(seed), {}};
    const std::vector<int> drawn = chosen_contacts(choice, kContacts);
    ASSERT_EQ(drawn.size(), 3U);
    for (const int contact : drawn) ++count[static_cast<std::size_t>(contact)];
  }
  const double expected = 0.3 * kDraws;
  for (const int drawn : count) EXPECT_NEAR(drawn, expected, 5 * std::sqrt(expected * 0.7));
  EXPECT_EQ(chosen_contacts({ContactChoice::Kind::kSample, 99, 1, {}}, 4), (std::vector<int>{0, 1, 2, 3}));
}

TEST(SampleEstimate, KnowsTheTextbookNumbers) {
  // t of 4 degrees of freedom at 0.975 is 2.776445; mean 3, variance 2.5.
  const SampleEstimate estimate = estimate_from_sample({1, 2, 3, 4, 5}, 50);
  EXPECT_EQ(estimate.mean, 3);
  EXPECT_NEAR(estimate.high - 3, 2.7764451051977987 * std::sqrt(2.5 / 5 * 0.9), 1e-12);
  EXPECT_NEAR(estimate.low + estimate.high, 6, 1e-12);
  EXPECT_NEAR(estimate.band, std::sqrt(std::log(40.0) / 10 * (1 - 4.0 / 50)), 1e-12);
  const SampleEstimate all = estimate_from_sample({1, 2, 3}, 3);
  EXPECT_EQ(all.low, all.high);
  EXPECT_EQ(all.band, 0);
  EXPECT_TRUE(std::isnan(estimate_from_sample({1}, 3).low));
  const SampleEstimate infinite = estimate_from_sample({1, std::numeric_limits<double>::infinity()}, 3);
  EXPECT_TRUE(std::isinf(infinite.mean));
  EXPECT_TRUE(std::isnan(infinite.low));
}

/// Exponential values with an atom at 0, more skewed than δR is: its tail ends.
TEST(SampleEstimate, IntervalsAndBandsCover) {
  Random random(17);
  std::vector<double> values(160);
  double mean = 0;
  for (double& value : values) {
    value = random.uniform() < 0.1 ? 0 : -13 * std::log(1 - random.uniform());
    mean += value / 160;
  }
  std::vector<double> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  constexpr int kRepeats = 2000;
  for (const int size : {20, 40, 80}) {
    int intervals = 0;
    int bands = 0;
    for (int seed = 0; seed < kRepeats; ++seed) {
      std::vector<double> drawn;
      for (const int i :
           chosen_contacts({ContactChoice::Kind::kSample, size, static_cast<std::uint64_t>(seed), {}}, 160))
        drawn.push_back(values[static_cast<std::size_t>(i)]);
      const SampleEstimate estimate = estimate_from_sample(drawn, 160);
      intervals += estimate.low <= mean && mean <= estimate.high ? 1 : 0;
      std::sort(drawn.begin(), drawn.end());
      double worst = 0;
      for (const double v : sorted) {
        const auto below = [v](const std::vector<double>& all) {
          return static_cast<double>(std::upper_bound(all.begin(), all.end(), v) - all.begin()) /
                 static_cast<double>(all.size());
        };
        worst = std::max(worst, std::abs(below(drawn) - below(sorted)));
      }
      bands += worst <= estimate.band ? 1 : 0;
    }
    EXPECT_GT(intervals, 0.88 * kRepeats) << size;
    EXPECT_LT(intervals, 0.99 * kRepeats) << size;
    EXPECT_GT(bands, 0.94 * kRepeats) << size;
  }
}

}  // namespace
}  // namespace indet
