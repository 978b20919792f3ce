#include "libindet/range/contact_choice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

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

}  // namespace
}  // namespace indet
