#pragma once

#include <array>
#include <span>
#include <vector>

namespace indet::sim {

/// The two bodies of a contact for the order of a sweep; b < 0: a body that does not move.
struct ContactEnds {
  int a = 0, b = 0;
  bool operator==(const ContactEnds&) const = default;
};

/// Two contacts that a sweep solves at once; −1 where there is none.
using ContactPair = std::array<int, 2>;

/// The order in which Gauss–Seidel visits contacts: as near to that of `contacts` as can be, but the two of a
/// pair share no moving body, and neither moves a body that one of the pairs just before has moved, as long
/// as there are others to take. Successive updates of one body must wait for each other; of different bodies
/// they overlap in the processor. Entry c of `contacts` occurs once. `bodies` is the number of body rows.
std::vector<ContactPair> sweep_order(std::span<const ContactEnds> contacts, int bodies);

/// Two successive pairs of an order at a time, where they share no moving body, so that the four can be
/// solved at once with the same result; else one pair and two places of −1.
std::vector<std::array<int, 4>> group_pairs(std::span<const ContactPair> order,
                                            std::span<const ContactEnds> contacts);

}  // namespace indet::sim
