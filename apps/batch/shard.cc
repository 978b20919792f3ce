#include "apps/batch/shard.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <functional>
#include <numeric>
#include <queue>
#include <utility>

namespace indet {

std::string Shard::name() const { return fmt::format("{}/{}", number, count); }

std::optional<Shard> shard_from(const std::string& text) {
  Shard shard;
  const char* const end = text.data() + text.size();
  const auto number = std::from_chars(text.data(), end, shard.number);
  if (number.ec != std::errc() || number.ptr == end || *number.ptr != '/') return std::nullopt;
  const auto count = std::from_chars(number.ptr + 1, end, shard.count);
  if (count.ec != std::errc() || count.ptr != end) return std::nullopt;
  if (shard.number < 1 || shard.number > shard.count) return std::nullopt;
  return shard;
}

std::vector<int> deal(const std::vector<double>& costs, int count) {
  std::vector<std::size_t> order(costs.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return costs[a] > costs[b]; });
  using Share = std::pair<double, int>;  // cost so far, number
  std::priority_queue<Share, std::vector<Share>, std::greater<>> shares;
  for (int number = 1; number <= count; ++number) shares.emplace(0.0, number);
  std::vector<int> share_of(costs.size());
  for (const std::size_t group : order) {
    auto [cost, number] = shares.top();
    shares.pop();
    share_of[group] = number;
    shares.emplace(cost + costs[group], number);
  }
  return share_of;
}

std::vector<double> costs_of_shares(const std::vector<double>& costs, int count) {
  const std::vector<int> share_of = deal(costs, count);
  std::vector<double> sums(static_cast<std::size_t>(count), 0);
  for (std::size_t group = 0; group < costs.size(); ++group)
    sums[static_cast<std::size_t>(share_of[group] - 1)] += costs[group];
  return sums;
}

}  // namespace indet
