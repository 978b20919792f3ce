#include "configuration.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <sstream>

#include "indet/base/error.h"

namespace indet::app {
namespace {

/// Options that say where or how a run is made, not what it computes.
bool is_setting(const CLI::Option& option) {
  static const std::vector<std::string> excluded = {"help", "version", "config"};
  return !option.get_lnames().empty() &&
         std::find(excluded.begin(), excluded.end(), option.get_lnames().front()) == excluded.end();
}

std::string text_of(const toml::node& node, const std::string& place) {
  if (const auto* value = node.as_string()) return value->get();
  if (const auto* value = node.as_integer()) return fmt::format("{}", value->get());
  if (const auto* value = node.as_floating_point()) return fmt::format("{}", value->get());
  if (const auto* value = node.as_boolean()) return value->get() ? "true" : "false";
  throw InputError(place + ": expected text, a number, true or false, or a list of these");
}

/// Adds "--key=value" for every key of a table that is not set otherwise.
void add_settings(const toml::table& table, const CLI::App& command, const std::string& file,
                  std::vector<std::string>& out) {
  for (const auto& [key, node] : table) {
    if (node.is_table()) continue;
    const std::string name(key.str());
    const std::string place = fmt::format("{}:{}: {}", file, node.source().begin.line, name);
    const CLI::Option* option = command.get_option_no_throw("--" + name);
    if (option == nullptr || !is_setting(*option)) {
      throw InputError(fmt::format("{} is not an option of '{}' (see {} --help)", place, command.get_name(),
                                   command.get_name()));
    }
    if (option->count() > 0) continue;  // the command line or the environment comes first
    if (const auto* array = node.as_array()) {
      out.push_back("--" + name);
      for (const auto& item : *array) out.push_back(text_of(item, place));
    } else {
      out.push_back(fmt::format("--{}={}", name, text_of(node, place)));
    }
  }
}

/// A value as TOML: a flag is a boolean, digits are a number, the rest is text.
void insert(toml::table& table, const CLI::Option& option) {
  const std::string name = option.get_lnames().front();
  if (option.get_expected_max() == 0) {
    table.insert(name, option.count() > 0 && option.results().front() != "false");
    return;
  }
  std::vector<std::string> values = option.results();
  if (values.empty() && !option.get_default_str().empty()) values = {option.get_default_str()};
  if (values.empty()) return;
  const auto add = [](auto& container, const std::string& value, auto... key) {
    double number = 0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
    const bool is_number = error == std::errc() && end == value.data() + value.size();
    const bool is_integer = is_number && value.find_first_not_of("+-0123456789") == std::string::npos;
    if constexpr (sizeof...(key) == 1) {
      if (is_integer)
        container.insert(key..., std::stoll(value));
      else if (is_number)
        container.insert(key..., number);
      else
        container.insert(key..., value);
    } else {
      if (is_integer)
        container.push_back(std::stoll(value));
      else if (is_number)
        container.push_back(number);
      else
        container.push_back(value);
    }
  };
  if (values.size() == 1) {
    add(table, values.front(), name);
    return;
  }
  toml::array array;
  for (const std::string& value : values) add(array, value);
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
                              const std::string& config_file) {
  const auto parse = [&root](std::vector<std::string> list) {
    std::reverse(list.begin(), list.end());  // CLI11 takes them last first
    root.parse(list);
  };
  parse(arguments);
  if (config_file.empty()) return;
  const std::string file = config_file;
  toml::table table;
  try {
    table = toml::parse_file(file);
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}:{}: {}", file, error.source().begin.line, error.description()));
  }
  std::vector<std::string> all = arguments;
  add_settings(table, root, file, all);
  for (const auto& [key, node] : table) {
    if (!node.is_table()) continue;
    const std::string name(key.str());
    const auto commands =
        root.get_subcommands([&](const CLI::App* candidate) { return candidate->get_name() == name; });
    if (commands.empty()) {
      throw InputError(fmt::format("{}:{}: '{}' is not a subcommand", file, node.source().begin.line, name));
    }
    const CLI::App* command = commands.front();
    if (command->parsed()) add_settings(*node.as_table(), *command, file, all);
  }
  parse(all);
}

std::string resolved_configuration(const CLI::App& root, const CLI::App& command) {
  toml::table table = settings_of(root);
  table.insert(command.get_name(), settings_of(command));
  std::ostringstream text;
  text << table << '\n';
  return text.str();
}

}  // namespace indet::app
