#include "apps/help_format.h"

#include <fmt/format.h>

#include <sstream>

namespace indet::app {
namespace {

constexpr std::size_t kScreen = 110;

/// UTF-8 continues a character in bytes 10xxxxxx.
std::size_t characters(const std::string& text) {
  std::size_t count = 0;
  for (const char c : text) count += (static_cast<unsigned char>(c) & 0xC0) != 0x80 ? 1 : 0;
  return count;
}

/// "TEXT:{csv,svg}" → "{csv,svg}", "TEXT:FILE" → "FILE", "UINT:NONNEGATIVE" → "INT"; other names stay.
std::string type_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  for (const std::string name : {"TEXT", "INT", "UINT", "FLOAT"}) {
    const std::string shown = name == "UINT" ? "INT" : name;
    if (type == name) return shown;
    if (!type.starts_with(name + ":")) continue;
    const std::string check = type.substr(name.size() + 1);
    return check == "NONNEGATIVE" || check == "POSITIVE" ? shown : check;
  }
  return type;
}

}  // namespace

std::string wrapped(const std::string& text, std::size_t width) {
  std::istringstream words(text);
  std::string result;
  std::size_t length = 0;
  for (std::string word; words >> word;) {
    const std::size_t size = characters(word);
    if (length > 0) {
      const bool fits = length + 1 + size <= width;
      result += fits ? ' ' : '\n';
      length = fits ? length + 1 : 0;
    }
    result += word;
    length += size;
  }
  return result;
}

std::string HelpFormat::make_option_opts(const CLI::Option* option) const {
  if (option->get_type_size() == 0) return {};
  std::string text = type_of(*option).empty() ? "" : " " + type_of(*option);
  if (option->get_expected_max() == CLI::detail::expected_max_vector_size)
    text += " ...";
  else if (option->get_expected_min() > 1)
    text += fmt::format(" x {}", option->get_expected());
  if (!option->get_default_str().empty()) text += fmt::format(" [{}]", option->get_default_str());
  if (option->get_required()) text += " (required)";
  return text;
}

std::string HelpFormat::make_option_desc(const CLI::Option* option) const {
  return wrapped(option->get_description(), kScreen - get_column_width());
}

std::string HelpFormat::make_subcommand(const CLI::App* command) const {
  std::ostringstream text;
  CLI::detail::format_help(text, command->get_name(),
                           wrapped(command->get_description(), kScreen - get_column_width()),
                           get_column_width());
  return text.str();
}

}  // namespace indet::app
