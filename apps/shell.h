#pragma once

#include <string>
#include <vector>

namespace indet::app {

/// The first line that a command of the shell prints; empty where it prints none, or cannot be run.
std::string first_line_of(const std::string& command);

/// As a shell reads it again.
std::string shell_quoted(const std::string& word);
std::string shell_quoted(const std::vector<std::string>& words);

}  // namespace indet::app
