#include "libsim/sweep_order.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>

namespace indet::sim {
namespace {

/// Contacts of a hexagonal packing of width × height disks on a floor, disk by disk.
std::vector<ContactEnds> lattice(int width, int height) {
  std::vector<ContactEnds> contacts;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int disk = y * width + x;
      if (y == 0) contacts.push_back({disk, -1});
      if (x + 1 < width) contacts.push_back({disk, disk + 1});
      if (y + 1 < height) contacts.push_back({disk, disk + width});
      if (y + 1 < height && x > 0) contacts.push_back({disk, disk + width - 1});
    }
  }
  return contacts;
}

std::vector<int> places(const std::vector<ContactPair>& order, int contacts) {
  std::vector<int> place(contacts, -1);
  for (int pair = 0; pair < static_cast<int>(order.size()); ++pair) {
    for (const int contact : order[pair]) {
      if (contact < 0) continue;
      EXPECT_EQ(place[contact], -1) << "contact " << contact << " occurs twice";
      place[contact] = pair;
    }
  }
  return place;
}

bool share(const ContactEnds& p, const ContactEnds& q) {
  return p.a == q.a || (q.b >= 0 && p.a == q.b) || (p.b >= 0 && (p.b == q.a || p.b == q.b));
}

TEST(SweepOrder, TakesEveryContactOnceAndNoBodyTwiceAtATime) {
  const auto contacts = lattice(7, 6);
  const auto order = sweep_order(contacts, 42);
  EXPECT_THAT(places(order, static_cast<int>(contacts.size())), testing::Each(testing::Ge(0)));
  for (const auto& [p, q] : order) {
    if (p < 0 || q < 0) continue;
    EXPECT_FALSE(share(contacts[p], contacts[q])) << p << " and " << q;
  }
}

TEST(SweepOrder, LetsBodiesRestAndStaysNearTheGivenOrder) {
  const auto contacts = lattice(20, 20);
  const int count = static_cast<int>(contacts.size());
  const auto order = sweep_order(contacts, 400);
  const auto place = places(order, count);
  // Towards the end there are only neighbours left.
  const int last = static_cast<int>(order.size()) - 10;
  for (int i = 0; i < count; ++i) {
    EXPECT_LT(std::abs(2 * place[i] - i), 100) << i;
    for (int j = 0; j < i; ++j) {
      if (!share(contacts[i], contacts[j]) || std::max(place[i], place[j]) >= last) continue;
      EXPECT_GT(std::abs(place[i] - place[j]), 4) << i << " and " << j;
    }
  }
}

TEST(SweepOrder, LeavesPlacesEmptyWhereAllContactsShareABody) {
  const std::vector<ContactEnds> star{{0, 1}, {0, 2}, {0, 3}, {0, -1}};
  EXPECT_THAT(sweep_order(star, 4), testing::ElementsAre(ContactPair{0, -1}, ContactPair{1, -1},
                                                         ContactPair{2, -1}, ContactPair{3, -1}));
  EXPECT_TRUE(sweep_order({}, 4).empty());
}

TEST(GroupPairs, JoinPairsInTheirOrderAndNoBodyTwice) {
  for (const auto& contacts : {lattice(7, 6), lattice(20, 20)}) {
    const auto order = sweep_order(contacts, 400);
    std::vector<ContactPair> pairs;
    std::size_t full = 0;
    const auto groups = group_pairs(order, contacts);
    for (const auto& group : groups) {
      pairs.push_back({group[0], group[1]});
      if (group[2] >= 0) pairs.push_back({group[2], group[3]});
      full += group[2] >= 0 ? 1 : 0;
      for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = 0; j < i; ++j) {
          if (group[i] < 0 || group[j] < 0) continue;
          EXPECT_FALSE(share(contacts[group[i]], contacts[group[j]])) << group[i] << " and " << group[j];
        }
      }
    }
    EXPECT_EQ(pairs, order);
    EXPECT_GT(full, 3 * groups.size() / 4);
  }
}

}  // namespace
}  // namespace indet::sim
