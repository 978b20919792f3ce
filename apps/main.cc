#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <new>
#include <string>

#include "apps/command.h"
#include "apps/configuration.h"
#include "apps/memory_limit.h"
#include "apps/terminal.h"
#include "libindet/base/error.h"
#include "libindet/base/version.h"

namespace indet::app {
namespace {

constexpr const char* kDescription =
    "indet tells within what limits the contact forces of a static packing of rigid disks with Coulomb "
    "friction can vary.";
constexpr const char* kFooter =
    "Options come from flags, then environment variables (INDET_THREADS for --threads), then the file given "
    "with --config.\n"
    "Exit status: 0 done; 1 internal error; 2 usage; 3 bad input, nothing written; 4 the packing has no "
    "admissible\n"
    "contact state; 5 done, but something is imprecise or not solved; 128+n on signal n.";

std::vector<Command> add_commands(CLI::App& root) {
  std::vector<Command> commands = {
      add_simulate(root), add_import(root), add_analyze(root), add_compare(root),    add_sample(root),
      add_inspect(root),  add_verify(root), add_export(root),  add_trajectory(root), add_completion(root),
      add_ensemble(root), add_merge(root),  add_report(root)};
  for (const Command& command : commands) {
    command.options->fallthrough();  // global options may follow the subcommand
    name_environment_variables(*command.options);
  }
  return commands;
}

int run(int argc, char** argv) {
  CLI::App root(kDescription, "indet");
  root.footer(kFooter);
  root.set_version_flag("--version", "indet " + version() + " (" + git_revision() + ")",
                        "Print the version and exit");
  root.require_subcommand(1);
  Context context;
  root.add_option("--config", context.config_file,
                  "Read options from this TOML file (a table for each subcommand)")
      ->type_name("FILE");
  root.add_option("--threads", context.threads, "Threads to use; results do not depend on it (0: one a core)")
      ->check(not_negative())
      ->capture_default_str();
  root.add_flag("--json", context.json, "Print one JSON document on stdout");
  root.add_flag("--quiet", context.quiet, "Print neither progress nor notes");
  name_environment_variables(root);
  const std::vector<Command> commands = add_commands(root);
  context.arguments.assign(argv, argv + argc);

  std::vector<std::string> arguments(argv + 1, argv + argc);
  try {
    parse_with_configuration(root, arguments, context.config_file);
  } catch (const CLI::RequiredError& error) {
    if (root.get_subcommands().empty() && !root.remaining().empty()) {
      throw UsageError(fmt::format("'{}' is not a subcommand (see indet --help)", root.remaining().front()));
    }
    return root.exit(error) == 0 ? kDone : kUsage;
  } catch (const CLI::ParseError& error) {
    return root.exit(error) == 0 ? kDone : kUsage;
  }
  for (const Command& command : commands) {
    if (!command.options->parsed()) continue;
    context.resolved_config = resolved_configuration(root, *command.options);
    return command.run(context);
  }
  return kUsage;
}

}  // namespace
}  // namespace indet::app

int main(int argc, char** argv) {
  using namespace indet;
  app::catch_signals();
  const auto complain = [](const char* message) { std::cerr << "indet: " << message << '\n'; };
  if (const std::string lack = app::lack_of_memory(); !lack.empty()) {
    complain(lack.c_str());
    std::_Exit(app::kInternalError);  // threads of OpenBLAS that wait for memory would not end
  }
  try {
    return app::run(argc, argv);
  } catch (const Interrupted&) {
    complain("interrupted; nothing was written");
    return 128 + app::caught_signal();
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
