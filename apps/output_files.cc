#include "apps/output_files.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <iostream>
#include <optional>
#include <utility>

#include "apps/trial_reading.h"

namespace indet::app {
namespace {

std::optional<FileKind> recognise_on_trial(const std::filesystem::path& path) {
  try {
    try_reading({path}, [](const std::filesystem::path& file) { recognise(file); });
  } catch (const InputError&) {
    return {};
  }
  return recognise(path);
}

/// A pipe, or a file that the shell made. (/dev/null and terminals take both.)
bool is_standard_output(const std::filesystem::path& output) {
  struct stat file {};
  struct stat standard {};
  return stat(output.c_str(), &file) == 0 && fstat(STDOUT_FILENO, &standard) == 0 &&
         file.st_dev == standard.st_dev && file.st_ino == standard.st_ino && !S_ISCHR(file.st_mode);
}

}  // namespace

void add_overwrite_option(CLI::App& command, bool& overwrite) {
  command.add_flag(
      "--overwrite", overwrite,
      "Also replace files of another kind than those that this command writes, and files of other "
      "programs");
}

Replacement replacement_rule(std::vector<std::filesystem::path> inputs, bool overwrite,
                             const Context& context) {
  if (!context.config_file.empty()) inputs.emplace_back(context.config_file);
  return {std::move(inputs), overwrite, &recognise_on_trial};
}

void claim_output(const std::filesystem::path& output, FileKind kind, const Replacement& rule) {
  rule.require(output, kind);
  if (!is_standard_output(output)) return;
  std::cout.rdbuf(std::cerr.rdbuf());
  stdout = stderr;  // in the GNU library these are variables
}

}  // namespace indet::app
