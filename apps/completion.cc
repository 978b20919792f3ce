#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <memory>
#include <string>

#include "apps/command.h"

namespace indet::app {
namespace {

/// The values that options accept, as shell cases: "--format) words='csv svg' ;;".
std::string values_of(const CLI::App& command, const std::string& name_of_command) {
  std::string text;
  for (const CLI::Option* option : command.get_options()) {
    const std::string type = option->get_type_name();  // TEXT:{csv,svg}
    const std::size_t open = type.find(":{");
    if (open == std::string::npos || type.back() != '}') continue;
    std::string words = type.substr(open + 2, type.size() - open - 3);
    std::replace(words.begin(), words.end(), ',', ' ');
    for (const std::string& name : option->get_lnames())
      text += fmt::format("    {}/--{}) COMPREPLY=($(compgen -W '{}' -- \"$current\")); return ;;\n",
                          name_of_command, name, words);
    if (option->get_lnames().empty())
      text += fmt::format("    {0}/{0}) COMPREPLY=($(compgen -W '{1}' -- \"$current\")); return ;;\n",
                          name_of_command, words);
  }
  return text;
}

/// The long options of a command, blank-separated.
std::string options_of(const CLI::App& command) {
  std::string text;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) text += "--" + name + " ";
  }
  return text;
}

std::string bash_script(const CLI::App& root) {
  std::string subcommands;
  std::string cases;
  std::string values;
  for (const CLI::App* command : root.get_subcommands([](const CLI::App*) { return true; })) {
    subcommands += command->get_name() + " ";
    std::string words = options_of(*command);
    values += values_of(*command, command->get_name());
    for (const CLI::App* nested : command->get_subcommands([](const CLI::App*) { return true; })) {
      words += nested->get_name() + " " + options_of(*nested);
      values += values_of(*nested, command->get_name());
    }
    cases += fmt::format("      {0}) command={0} words='{1}{2}' ;;\n", command->get_name(), words,
                         options_of(root));
  }
  return fmt::format(
      "# bash completion for indet\n"
      "_indet() {{\n"
      "  local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD-1]}}\n"
      "  local words='{0}{1}' command= word\n"
      "  for word in \"${{COMP_WORDS[@]:1:COMP_CWORD-1}}\"; do\n"
      "    case $word in\n"
      "{2}"
      "    esac\n"
      "    [[ $command ]] && break\n"
      "  done\n"
      "  [[ $current == -* ]] || case $command/$previous in\n"
      "{3}"
      "  esac\n"
      "  if [[ $current == -* || ! $command ]]; then\n"
      "    COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n"
      "  else\n"
      "    local IFS=$'\\n'\n"
      "    COMPREPLY=($(compgen -f -- \"$current\"))\n"
      "  fi\n"
      "}}\n"
      "complete -o filenames -F _indet indet\n",
      subcommands, options_of(root), cases, values);
}

}  // namespace

Command add_completion(CLI::App& root) {
  CLI::App* command = root.add_subcommand(
      "completion", "Print a script that completes commands in a shell: source <(indet completion bash)");
  const auto shell = std::make_shared<std::string>();
  command->add_option("shell", *shell, "The shell to complete for")
      ->required()
      ->check(CLI::IsMember({"bash"}));
  return {command, [&root, shell](const Context&) {
            std::cout << bash_script(root);
            return kDone;
          }};
}

}  // namespace indet::app
