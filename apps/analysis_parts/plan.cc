#include "apps/analysis_parts/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "libindet/base/error.h"
#include "libindet/base/toml_text.h"
#include "libindet/base/version.h"
#include "libindet/io/sha256.h"
#include "libindet/range/analysis_start.h"
#include "libindet/range/dealt_analysis.h"

namespace indet {
namespace {

/// Contacts of a chunk: little is lost with one in hand, and of large packings there are not too many files,
/// each of which has the packing.
int chunk_size(int contacts) { return contacts < 1000 ? 16 : 64; }

/// Seconds of a contact on one core, measured with 340 to 2760 contacts (docs/decisions/dealt-analysis.md).
double cost_of_contact(int contacts, const AnalyzeOptions& options) {
  const double values = 0.0073 * std::pow(contacts / 1360.0, 1.7);
  const bool has_states = kept_states(options, contacts).kind != StateChoice::Kind::kNone;
  return values * (1 + (has_states ? 7 : 0) + (options.smallest_distances ? 9 : 0));
}

std::string options_toml(const AnalyzeOptions& options, int contacts,
                         const std::vector<std::string>& conditions) {
  const StateChoice states = kept_states(options, contacts);
  std::string text = fmt::format(
      "method = \"{}\"\ngap = {}\nstates = \"{}\"\nstates_of = \"{}\"\n",
      options.method ? to_string(*options.method) : "auto", options.gap, to_string(states.kind),
      states.contacts == StateChoice::Contacts::kList ? to_list(states.list) : to_string(states.contacts));
  text +=
      fmt::format("reactions = {}\nsmallest_distances = {}\n", options.reactions, options.smallest_distances);
  using Duals = DualChoice::Kind;
  if (options.duals.kind == Duals::kAll) text += "duals = \"all\"\n";
  if (options.duals.kind == Duals::kSample)
    text += fmt::format("duals = \"sample:{}\"\nseed = {}\n", options.duals.sample_size, options.duals.seed);
  for (const std::string& condition : conditions)
    text += fmt::format("[[condition]]\ntext = {}\n", toml_text(condition));
  return text;
}

}  // namespace

std::string to_list(const std::vector<int>& numbers) {
  std::string text;
  for (std::size_t k = 0; k < numbers.size();) {
    std::size_t end = k + 1;
    while (end < numbers.size() && numbers[end] == numbers[end - 1] + 1) ++end;
    if (!text.empty()) text += ",";
    text += end == k + 1 ? fmt::format("{}", numbers[k]) : fmt::format("{}-{}", numbers[k], numbers[end - 1]);
    k = end;
  }
  return text;
}

std::vector<int> from_list(const std::string& text) {
  std::vector<int> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  const auto read = [&](int& number) {
    const auto [stop, error] = std::from_chars(at, end, number);
    at = stop;
    return error == std::errc() && number >= 0;
  };
  constexpr int kMost = 100'000'000;  // a hostile list has no room to grow
  while (at != end) {
    int first = 0, last = 0;
    if (!read(first)) return {};
    last = first;
    if (at != end && *at == '-' && (++at, !read(last))) return {};
    const bool is_ascending = numbers.empty() || first > numbers.back();
    if (!is_ascending || last < first || last > kMost) return {};
    for (int number = first; number <= last; ++number) numbers.push_back(number);
    if (at != end && (*at != ',' || ++at == end)) return {};
  }
  return numbers;
}

std::string AnalysisPlan::hash() const {
  std::string text = version + "\n" + packing + "\n" + options;
  for (const Chunk& chunk : chunks) text += to_list(chunk.contacts) + "\n";
  Sha256 sha;
  sha.update(text.data(), text.size());
  return sha.hex();
}

AnalysisPlan make_analysis_plan(const std::string& packing, int contacts, const AnalyzeOptions& options,
                                const std::vector<std::string>& conditions) {
  if (const auto obstacle = obstacle_to_dealing(options, contacts)) throw InputError(*obstacle);
  AnalysisPlan plan{version(), packing, options_toml(options, contacts, conditions), options.contacts, {}};
  const std::vector<int> all = chosen_contacts(options.contacts, contacts);
  if (all.empty()) throw InputError("there is no contact to analyse");
  const auto size = static_cast<std::size_t>(chunk_size(contacts));
  const double cost = cost_of_contact(contacts, options);
  for (std::size_t first = 0; first < all.size(); first += size) {
    const auto from = all.begin() + static_cast<std::ptrdiff_t>(first);
    const auto to = all.begin() + static_cast<std::ptrdiff_t>(std::min(all.size(), first + size));
    Chunk chunk{{}, {from, to}, 0};
    chunk.name = fmt::format("contacts-{:04}-{:04}", chunk.contacts.front(), chunk.contacts.back());
    chunk.cost = cost * static_cast<double>(chunk.contacts.size());
    plan.chunks.push_back(std::move(chunk));
  }
  return plan;
}

}  // namespace indet
