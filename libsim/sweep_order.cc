#include "libsim/sweep_order.h"

#include <algorithm>
#include <limits>

namespace indet::sim {
namespace {

/// A body moved by one pair should not be moved by this many pairs after it: about as many as a processor
/// works on at once.
constexpr int kSpacing = 4;
/// Contacts that are looked at for the next place. Few, so that the order stays near the given one.
constexpr int kWindow = 64;

constexpr int kNever = std::numeric_limits<int>::min() / 2;

/// True if two contacts move one body.
bool share(const ContactEnds& p, const ContactEnds& q) {
  return p.a == q.a || p.a == q.b || (p.b >= 0 && (p.b == q.a || p.b == q.b));
}

}  // namespace

std::vector<ContactPair> sweep_order(std::span<const ContactEnds> contacts, int bodies) {
  const int count = static_cast<int>(contacts.size());
  std::vector<int> moved(static_cast<std::size_t>(bodies), kNever);  // the last pair that moved a body
  std::vector<int> next(static_cast<std::size_t>(count) + 1);  // list of those left; contact c is node c + 1
  for (int i = 0; i <= count; ++i) next[i] = i + 1;
  const auto last_move = [&](const ContactEnds& c) {
    return c.b < 0 ? moved[c.a] : std::max(moved[c.a], moved[c.b]);
  };
  std::vector<ContactPair> order;
  int left = count;
  for (int pair = 0; left > 0; ++pair) {
    ContactPair members{-1, -1};
    for (int& member : members) {
      int before_best = -1;  // node before the contact whose bodies have rested longest
      int longest_rest = 0;
      int before = 0;
      for (int looked = 0; looked < kWindow && next[before] <= count; ++looked, before = next[before]) {
        const int rest = pair - last_move(contacts[next[before] - 1]);
        if (rest > longest_rest) {
          longest_rest = rest;
          before_best = before;
        }
        if (rest > kSpacing) break;
      }
      if (before_best < 0) continue;
      const int node = next[before_best];
      next[before_best] = next[node];
      member = node - 1;
      moved[contacts[member].a] = pair;
      if (contacts[member].b >= 0) moved[contacts[member].b] = pair;
      --left;
    }
    order.push_back(members);
  }
  return order;
}

std::vector<std::array<int, 4>> group_pairs(std::span<const ContactPair> order,
                                            std::span<const ContactEnds> contacts) {
  std::vector<std::array<int, 4>> groups;
  for (std::size_t i = 0; i < order.size(); ++i) {
    groups.push_back({order[i][0], order[i][1], -1, -1});
    if (i + 1 == order.size()) break;
    const bool apart = std::all_of(order[i].begin(), order[i].end(), [&](int first) {
      return std::all_of(order[i + 1].begin(), order[i + 1].end(), [&](int second) {
        return first < 0 || second < 0 || !share(contacts[first], contacts[second]);
      });
    });
    if (!apart) continue;
    ++i;
    groups.back()[2] = order[i][0];
    groups.back()[3] = order[i][1];
  }
  return groups;
}

}  // namespace indet::sim
