#include "apps/configuration.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <map>
#include <sstream>

#include "apps/numbers.h"
#include "apps/suggestion.h"
#include "libindet/base/error.h"
#include "libindet/base/printable.h"

namespace indet::app {
namespace {

/// False for options that say how this one run is made: a configuration that is read again does not carry
/// them, and least of all the permission to overwrite.
bool is_setting(const CLI::Option& option) {
  static const std::vector<std::string> excluded = {"help", "version", "config", "overwrite"};
  return !option.get_lnames().empty() &&
         std::find(excluded.begin(), excluded.end(), option.get_lnames().front()) == excluded.end();
}

std::vector<std::string> names_of_options(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    if (is_setting(*option)) names.push_back(option->get_lnames().front());
  }
  return names;
}

std::string text_of(const toml::node& node, const std::string& place) {
  if (const auto* value = node.as_string()) return value->get();
  if (const auto* value = node.as_integer()) return fmt::format("{}", value->get());
  if (const auto* value = node.as_floating_point()) return fmt::format("{}", value->get());
  if (const auto* value = node.as_boolean()) return value->get() ? "true" : "false";
  throw InputError(place + ": expected text, a number, true or false, or a list of these");
}

/// Options that a file sets.
struct Settings {
  std::vector<std::string> arguments;         ///< as on a command line
  std::map<std::string, std::string> places;  ///< "--key" → "FILE:LINE: key"
};

/// Adds "--key=value" for every key of a table that is not set otherwise. Options of a subcommand that does
/// not run are checked, and left out.
void add_settings(const toml::table& table, const CLI::App& command, const std::string& file, bool runs,
                  Settings& settings) {
  for (const auto& [key, node] : table) {
    const CLI::Option* option = command.get_option_no_throw("--" + std::string(key.str()));
    const bool is_root = command.get_parent() == nullptr;
    if (node.is_table() && is_root && option == nullptr) continue;  // of a subcommand
    const std::string name(key.str());
    const std::string place = fmt::format("{}:{}: {}", file, node.source().begin.line, excerpt(name));
    if (option == nullptr || !is_setting(*option)) {
      const std::string words = is_root ? command.get_name() : "indet " + command.get_name();
      throw InputError(fmt::format("{}: {} has no such option{}; see {} --help", place, words,
                                   suggestion(name, names_of_options(command)), words));
    }
    std::vector<std::string> values;
    if (const auto* array = node.as_array()) {
      for (const auto& item : *array) values.push_back(text_of(item, place));
    } else {
      values.push_back(text_of(node, place));
    }
    if (!runs || option->count() > 0) continue;  // the command line or the environment comes first
    settings.places["--" + name] = place;
    if (node.is_array()) {
      // A value that looks like an option is one only if it stands alone.
      const bool looks_like_options = std::any_of(
          values.begin(), values.end(), [](const std::string& value) { return value.starts_with("--"); });
      if (!looks_like_options) settings.arguments.push_back("--" + name);
      for (const std::string& value : values)
        settings.arguments.push_back(looks_like_options ? fmt::format("--{}={}", name, value) : value);
    } else {
      settings.arguments.push_back(fmt::format("--{}={}", name, values.front()));
    }
  }
}

toml::table read_toml(const std::string& file) {
  if (!std::filesystem::exists(file)) throw InputError(file + ": there is no such file");
  try {
    return toml::parse_file(file);
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}:{}: {}", file, error.source().begin.line, error.description()));
  }
}

/// A value as TOML: of an option that takes numbers, or where it prints as it was given, a number; else text.
/// Calls `add` with it.
template <class Add>
void add_value(const CLI::Option& option, const std::string& value, const Add& add) {
  const bool is_number = takes_numbers(option);
  const char* const end = value.data() + value.size();
  std::int64_t whole = 0;
  double real = 0;
  if (const auto parsed = std::from_chars(value.data(), end, whole);
      parsed.ec == std::errc() && parsed.ptr == end && (is_number || fmt::format("{}", whole) == value))
    return add(whole);
  if (const auto parsed = std::from_chars(value.data(), end, real);
      parsed.ec == std::errc() && parsed.ptr == end && (is_number || fmt::format("{}", real) == value))
    return add(real);
  add(value);
}

void insert(toml::table& table, const CLI::Option& option) {
  const std::string name = option.get_lnames().front();
  if (option.get_expected_max() == 0) {
    table.insert(name, option.count() > 0 && option.results().front() != "false");
    return;
  }
  std::vector<std::string> values = option.results();
  if (values.empty() && !option.get_default_str().empty()) values = {option.get_default_str()};
  if (values.empty()) return;
  if (values.size() == 1) {
    add_value(option, values.front(), [&](const auto& value) { table.insert(name, value); });
    return;
  }
  toml::array array;
  for (const std::string& text : values)
    add_value(option, text, [&](const auto& value) { array.push_back(value); });
  table.insert(name, array);
}

toml::table settings_of(const CLI::App& command) {
  toml::table table;
  for (const CLI::Option* option : command.get_options()) {
    if (is_setting(*option)) insert(table, *option);
  }
  return table;
}

}  // namespace

void name_environment_variables(CLI::App& command) {
  for (CLI::Option* option : command.get_options()) {
    if (option->get_lnames().empty() || option->get_lnames().front() == "help" ||
        option->get_lnames().front() == "version")
      continue;
    std::string name = "INDET_" + option->get_lnames().front();
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return c == '-' ? '_' : static_cast<char>(std::toupper(c)); });
    option->envname(name);
  }
}

void parse_with_configuration(CLI::App& root, const std::vector<std::string>& arguments,
                              const std::string& file) {
  parse_numbers(root, arguments);
  if (file.empty()) return;
  const toml::table table = read_toml(file);
  Settings settings;
  add_settings(table, root, file, true, settings);
  for (const auto& [key, node] : table) {
    if (!node.is_table()) continue;
    const std::string name(key.str());
    const auto commands =
        root.get_subcommands([&](const CLI::App* candidate) { return candidate->get_name() == name; });
    if (commands.empty()) {
      std::vector<std::string> names;
      for (const CLI::App* command : root.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(command->get_name());
      throw InputError(fmt::format("{}:{}: '{}' is not a subcommand{}", file, node.source().begin.line,
                                   excerpt(name), suggestion(name, names)));
    }
    CLI::App* command = commands.front();
    for (CLI::App* running : root.get_subcommands()) {  // what is submitted has the options of its own table
      const auto submitted =
          running->get_subcommands([&](const CLI::App* candidate) { return candidate->get_name() == name; });
      if (!submitted.empty()) command = submitted.front();
    }
    add_settings(*node.as_table(), *command, file, command->parsed(), settings);
  }
  std::vector<std::string> all = arguments;
  all.insert(all.end(), settings.arguments.begin(), settings.arguments.end());
  try {
    parse_numbers(root, all);
  } catch (const CLI::ParseError& error) {
    // "--key: reason": the command line alone was fine, so the value comes from the file.
    const std::string text = error.what();
    const auto place = settings.places.find(text.substr(0, text.find(':')));
    if (place == settings.places.end()) throw;
    throw InputError(place->second + text.substr(place->first.size()));
  }
}

std::string resolved_configuration(const CLI::App& root, const CLI::App& command) {
  std::ostringstream text;
  text << settings_of(root) << "\n\n" << resolved_configuration(command);
  return text.str();
}

std::string resolved_configuration(const CLI::App& command) {
  toml::table table;
  table.insert(command.get_name(), settings_of(command));
  std::ostringstream text;
  text << table << '\n';
  return text.str();
}

}  // namespace indet::app
