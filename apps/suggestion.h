#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace indet::app {

/// " (did you mean --disks?)": the candidate that is nearest to a misspelt word, nothing if none is near.
/// Distance counts letters that are missing, superfluous, wrong or swapped with their neighbour; near is up
/// to a third of the word's letters, or a candidate that begins with the word.
std::string suggestion(const std::string& word, const std::vector<std::string>& candidates);

/// What is wrong with the first word of the command line that looks like an option or a subcommand and is
/// none, and what may have been meant; nothing if there is no such word. To be called after parsing failed.
std::string complaint_about_unknown_word(const CLI::App& root);

}  // namespace indet::app
