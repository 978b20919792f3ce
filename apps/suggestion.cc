#include "apps/suggestion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <limits>

namespace indet::app {
namespace {

/// Optimal string alignment distance.
std::size_t distance(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t wrong = a[i - 1] == b[j - 1] ? 0 : 1;
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + wrong});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[a.size()][b.size()];
}

void add_options(const CLI::App& command, std::vector<std::string>& names) {
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
}

}  // namespace

std::string suggestion(const std::string& word, const std::vector<std::string>& candidates) {
  const auto letters = [](const std::string& text) { return text.substr(text.find_first_not_of('-')); };
  if (word.find_first_not_of('-') == std::string::npos) return {};
  const std::string wanted = letters(word);
  std::size_t least = std::numeric_limits<std::size_t>::max();
  const std::string* nearest = nullptr;
  for (const std::string& candidate : candidates) {
    const std::string name = letters(candidate);
    const std::size_t d = wanted.size() > 1 && name.starts_with(wanted) ? 1 : distance(wanted, name);
    if (d > std::max<std::size_t>(1, wanted.size() / 3) || d >= least) continue;
    least = d;
    nearest = &candidate;
  }
  return nearest == nullptr ? std::string() : fmt::format(" (did you mean {}?)", *nearest);
}

std::string complaint_about_unknown_word(const CLI::App& root) {
  const std::vector<CLI::App*> parsed = root.get_subcommands();
  const std::vector<std::string> unknown = root.remaining(true);
  if (parsed.empty()) {
    if (unknown.empty()) return {};
    std::vector<std::string> names;
    add_options(root, names);
    for (const CLI::App* command : root.get_subcommands([](const CLI::App*) { return true; }))
      names.push_back(command->get_name());
    const std::string& word = unknown.front();
    return fmt::format("'{}' is {}{}; see indet --help", word,
                       word.starts_with("-") ? "not an option of indet" : "not a subcommand",
                       suggestion(word, names));
  }
  const auto found = std::find_if(unknown.begin(), unknown.end(), [](const std::string& word) {
    return word.size() > 1 && word.front() == '-';
  });
  if (found == unknown.end()) return {};
  const std::string word = found->substr(0, found->find('='));
  std::string command = "indet";
  std::vector<std::string> names;
  add_options(root, names);
  for (std::vector<CLI::App*> level = parsed; !level.empty(); level = level.front()->get_subcommands()) {
    command += " " + level.front()->get_name();
    add_options(*level.front(), names);
  }
  return fmt::format("{} has no option {}{}; see {} --help", command, word, suggestion(word, names), command);
}

}  // namespace indet::app
