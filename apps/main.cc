#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <iostream>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include "apps/command.h"
#include "apps/configuration.h"
#include "apps/help_format.h"
#include "apps/interruption.h"
#include "apps/memory_limit.h"
#include "apps/numbers.h"
#include "apps/suggestion.h"
#include "libindet/base/error.h"
#include "libindet/base/printable.h"
#include "libindet/base/version.h"

namespace indet::app {
namespace {

constexpr const char* kDescription =
    "indet finds between which limits each contact force of a static packing of rigid disks with Coulomb\n"
    "friction can vary, given only that forces balance.";
constexpr const char* kFooter =
    "--config, --threads, --json and --quiet may be given to every subcommand (see indet --help).\n"
    "What is not given is taken from an environment variable (INDET_THREADS for --threads), else from the "
    "file "
    "of\n--config.\n\n"
    "Exit status:\n"
    "  0      done\n"
    "  1      internal error\n"
    "  2      wrong usage\n"
    "  3      bad input; nothing was written\n"
    "  4      no contact forces balance the load within friction, and bounds where there are any\n"
    "  5      done, but some result is imprecise, failed or wrong\n"
    "  6      the time budget left something to do; the same command goes on\n"
    "  128+n  stopped by signal n\n";

std::vector<Command> add_commands(CLI::App& root) {
  std::vector<Command> commands = {
      add_simulate(root), add_import(root),     add_analyze(root),    add_limit(root),
      add_compare(root),  add_sample(root),     add_inspect(root),    add_verify(root),
      add_export(root),   add_trajectory(root), add_completion(root), add_ensemble(root),
      add_submit(root),   add_status(root),     add_merge(root),      add_report(root)};
  for (const Command& command : commands) {
    command.options->fallthrough();  // global options may follow the subcommand
    std::vector<CLI::App*> levels = command.options->get_subcommands([](CLI::App*) { return true; });
    levels.push_back(command.options);
    for (CLI::App* level : levels) {
      name_environment_variables(*level);
      require_numbers(*level);
    }
  }
  return commands;
}

/// The message as a terminal may show it, with excerpts of the long ones among the arguments that it quotes.
std::string with_short_words(std::string message, const std::vector<std::string>& arguments) {
  for (const std::string& argument : arguments) {
    // Of --name=value, the value may be quoted alone.
    for (const std::string& word : {argument, argument.substr(argument.find('=') + 1)}) {
      const std::string shorter = excerpt(word);
      if (shorter.size() >= word.size()) continue;
      for (std::size_t at = message.find(word); at != std::string::npos; at = message.find(word, at)) {
        message.replace(at, word.size(), shorter);
        at += shorter.size();
      }
    }
  }
  return printable(message);
}

int run(int argc, char** argv) {
  CLI::App root(kDescription, "indet");
  root.formatter(std::make_shared<HelpFormat>());  // subcommands inherit it
  root.footer(kFooter);
  root.set_version_flag("--version", "indet " + version() + " (" + git_revision() + ")",
                        "Print the version and exit");
  root.require_subcommand(1);
  Context context;
  root.add_option("--config", context.config_file,
                  "Read options from this TOML file, with a table per subcommand")
      ->type_name("FILE");
  root.add_option(
          "--threads", context.threads,
          "Number of threads (0: one per core, in a Slurm job one per processor of the task); results do "
          "not depend on it")
      ->check(not_negative())
      ->capture_default_str();
  root.add_flag("--json", context.json, "Print one JSON document on stdout instead of text");
  root.add_flag("--quiet", context.quiet,
                "Print nothing but warnings and errors (and, with --json, the document)");
  name_environment_variables(root);
  require_numbers(root);
  const std::vector<Command> commands = add_commands(root);
  context.arguments.assign(argv, argv + argc);

  std::vector<std::string> arguments(argv + 1, argv + argc);
  try {
    parse_with_configuration(root, arguments, context.config_file);
  } catch (const CLI::ParseError& error) {
    const bool wrong = error.get_exit_code() != 0;  // --help and --version are thrown too
    const std::string complaint = wrong ? complaint_about_unknown_word(root) : "";
    if (!complaint.empty()) throw UsageError(complaint);
    if (!wrong) return root.exit(error);
    throw UsageError(std::string(error.what()) + "\nRun with --help for more information.");
  }
  for (const Command& command : commands) {
    if (!command.options->parsed()) continue;
    context.resolved_config = resolved_configuration(root, *command.options);
    return command.run(context);
  }
  return kUsage;
}

/// What was printed may have been lost, on a full device: then the status says so.
void flush_output() {
  std::cout.flush();
  const bool lost = !std::cout || std::fflush(stdout) != 0 || std::ferror(stdout) != 0;
  if (lost) throw LibraryError(std::string("standard output could not be written: ") + std::strerror(errno));
}

}  // namespace
}  // namespace indet::app

int main(int argc, char** argv) {
  using namespace indet;
  app::catch_signals();
  const auto complain = [&](const char* message) {
    std::cerr << "indet: " << app::with_short_words(message, {argv + 1, argv + argc}) << '\n';
  };
  if (const std::string lack = app::lack_of_memory(); !lack.empty()) {
    complain(lack.c_str());
    std::_Exit(app::kInternalError);  // threads of OpenBLAS that wait for memory would not end
  }
  try {
    const int status = app::run(argc, argv);
    if (app::caught_signal() != 0 && !app::has_written()) return app::stopped();
    app::flush_output();
    return status;
  } catch (const Interrupted&) {
    return app::stopped();
  } catch (const app::UsageError& error) {
    complain(error.what());
    return app::kUsage;
  } catch (const InputError& error) {
    complain(error.what());
    return app::kBadInput;
  } catch (const std::bad_alloc&) {
    complain("out of memory");
  } catch (const std::exception& error) {
    complain(error.what());
  }
  return app::kInternalError;
}
