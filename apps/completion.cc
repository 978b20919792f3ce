#include <fmt/format.h>

#include <iostream>
#include <memory>
#include <string>

#include "command.h"

namespace indet::app {
namespace {

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
  for (const CLI::App* command : root.get_subcommands([](const CLI::App*) { return true; })) {
    subcommands += command->get_name() + " ";
    cases +=
        fmt::format("    {}) words='{}{}' ;;\n", command->get_name(), options_of(*command), options_of(root));
  }
  return fmt::format(
      "# bash completion for indet\n"
      "_indet() {{\n"
      "  local current=${{COMP_WORDS[COMP_CWORD]}} words='{0}{1}' word\n"
      "  for word in \"${{COMP_WORDS[@]:1:COMP_CWORD-1}}\"; do\n"
      "    case $word in\n"
      "{2}"
      "    esac\n"
      "  done\n"
      "  if [[ $current == -* || $COMP_CWORD -eq 1 ]]; then\n"
      "    COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n"
      "  else\n"
      "    COMPREPLY=($(compgen -f -- \"$current\"))\n"
      "  fi\n"
      "}}\n"
      "complete -o filenames -F _indet indet\n",
      subcommands, options_of(root), cases);
}

}  // namespace

Command add_completion(CLI::App& root) {
  CLI::App* command =
      root.add_subcommand("completion", "Print a shell completion script: source <(indet completion bash)");
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
