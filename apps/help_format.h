#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace indet::app {

/// `text` in lines of at most `width` characters, where its words allow it.
std::string wrapped(const std::string& text, std::size_t width);

/// How --help looks: what an option takes, and its default, in brackets; descriptions in lines that fit on a
/// screen. Environment variables follow one rule, which the footer tells.
class HelpFormat : public CLI::Formatter {
 public:
  std::string make_option_opts(const CLI::Option* option) const override;
  std::string make_option_desc(const CLI::Option* option) const override;
  std::string make_subcommand(const CLI::App* command) const override;
};

}  // namespace indet::app
