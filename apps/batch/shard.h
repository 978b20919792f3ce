#pragma once

#include <optional>
#include <string>
#include <vector>

namespace indet {

/// One of several shares of some work.
struct Shard {
  int number = 1;  ///< From 1.
  int count = 1;

  /// "3/8".
  std::string name() const;
};

/// "3/8", 1 ≤ number ≤ count; nothing if the text is no such share.
std::optional<Shard> shard_from(const std::string& text);

/// Deals groups of items, which stay together, to `count` shares: the dearest first, each to the share that
/// has least so far (the largest share is at most 4/3 of the smallest possible one, Graham 1969). Returns the
/// number of the share of each group, from 1; the same on every host.
std::vector<int> deal(const std::vector<double>& costs, int count);

/// What each of these shares costs.
std::vector<double> costs_of_shares(const std::vector<double>& costs, int count);

}  // namespace indet
