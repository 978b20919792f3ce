#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/wording.h"
#include "libindet/base/progress.h"

namespace indet::app {

/// Exit statuses of the program (128 + n on signal n).
enum ExitStatus : int {
  kDone = 0,
  kInternalError = 1,
  kUsage = 2,
  kBadInput = 3,  ///< Nothing was written.
  kNoAdmissibleState = 4,
  kUncertain = 5,  ///< Done, but something is imprecise or not solved.
  kOutOfTime = 6   ///< The time budget left something to do; the same command goes on.
};

/// The options contradict each other or something is missing: exit status 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What every subcommand shares: the global options, the terminal, the configuration that was resolved.
struct Context {
  int threads = 0;              ///< 0: as many as the task of a Slurm job has, else the machine.
  bool json = false;            ///< Print one JSON document on stdout instead of text.
  bool quiet = false;           ///< No report on stdout; neither progress nor notes on stderr.
  std::string config_file;      ///< Of --config; empty if there is none.
  std::string resolved_config;  ///< TOML of every option of this run, as stored in the files that it writes.
  std::vector<std::string> arguments;  ///< argv.

  int thread_count() const;

  /// Whether a subcommand prints its report as text: not with --json, nor with --quiet.
  bool prints_report() const { return !json && !quiet; }

  /// Draws a progress bar on stderr (on a terminal, and not with --quiet) once a stage has lasted half a
  /// second, and asks the library to stop once a signal has arrived.
  ProgressCallback progress() const;

  /// One line on stderr, unless --quiet.
  void note(const std::string& text) const;
  /// One line on stderr, always: "warning: …".
  void warn(const std::string& text) const;
};

/// A subcommand: its options live in `options`, `run` is called after parsing and returns the exit status.
/// Bad input is thrown as InputError; main turns exceptions into messages and exit statuses.
struct Command {
  CLI::App* options = nullptr;
  std::function<int(const Context&)> run;
};

// One file a subcommand.
Command add_import(CLI::App& root);
Command add_analyze(CLI::App& root);
Command add_limit(CLI::App& root);
Command add_compare(CLI::App& root);
Command add_inspect(CLI::App& root);
Command add_verify(CLI::App& root);
Command add_export(CLI::App& root);
Command add_simulate(CLI::App& root);
Command add_sample(CLI::App& root);
Command add_ensemble(CLI::App& root);
Command add_merge(CLI::App& root);
Command add_submit(CLI::App& root);
Command add_status(CLI::App& root);
Command add_report(CLI::App& root);
Command add_trajectory(CLI::App& root);
Command add_completion(CLI::App& root);

}  // namespace indet::app
