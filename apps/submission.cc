#include "apps/submission.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "apps/shell.h"
#include "apps/slurm_time.h"

namespace indet::app {
namespace {

/// Between USR1 and the end of the job. Slurm's clock ticks in half minutes.
constexpr int kWarning = 75;

std::string options_of(const Submission& s, const std::string& name) {
  const TaskResources& r = s.resources;
  std::string text = "#SBATCH --job-name=" + name + "\n";
  const auto add = [&](const std::string& option, const std::string& value) {
    if (!value.empty()) text += fmt::format("#SBATCH {}={}\n", option, value);
  };
  add("--partition", r.partition);
  add("--account", r.account);
  if (r.seconds > 0) add("--time", slurm_time(r.seconds));
  add("--cpus-per-task", std::to_string(r.processors));
  add("--mem", r.memory);
  add("--open-mode", "append");
  text += "#SBATCH --requeue\n";
  add("--signal", fmt::format("B:USR1@{}", kWarning));
  for (const std::string& line : r.lines) text += "#SBATCH " + line + "\n";
  return text;
}

/// Runs the command such that signals reach it, and puts the job back into the queue where time cut it short.
std::string body(const Submission& s) {
  const std::string records = shell_quoted((s.folder / "tasks").string());
  return fmt::format(
      R"(
cd -- {directory} || exit 3

# Slurm signals this script {warning} seconds before the time limit, and when the job is preempted. The program
# hears of it, keeps what it has, and ends with status 143; with 6 where time would not suffice for more.
signalled=
trap 'signalled=1; kill -TERM "$program" 2>/dev/null' USR1 TERM
{command} &
program=$!
wait "$program"; status=$?
while [ -n "$signalled" ]; do signalled=; wait "$program"; status=$?; done

# Once more, unless this start got nowhere: another one would not, either.
if [ "$status" = 143 ] || [ "$status" = 6 ]; then
  record=$(ls -t {records}/"$(uname -n | tr . -)-$program"-*.json 2>/dev/null | head -n 1)
  state=$(squeue -h -j "$SLURM_JOB_ID" -o %T)  # RUNNING, unless it is cancelled, or Slurm itself puts it back
  if [ "$state" = RUNNING ] && grep -qs '"got_further": true' "$record"; then
    echo "indet: back into the queue"
    scontrol requeue "$SLURM_JOB_ID" && exit 0
  fi
fi
)",
      fmt::arg("directory", shell_quoted(s.directory.string())), fmt::arg("warning", kWarning),
      fmt::arg("command", shell_quoted(s.command)), fmt::arg("records", records));
}

std::string job_name(const Submission& s) {
  std::string name = s.folder.filename().string();
  if (name.empty()) name = s.folder.parent_path().filename().string();
  std::replace_if(
      name.begin(), name.end(),
      [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-' && c != '_'; }, '_');
  return "indet-" + name;
}

/// sbatch reads a pattern: %A is the job, %a the task, %j the job.
std::string log_of(const Submission& s, const std::string& pattern) {
  return fmt::format("#SBATCH --output=\"{}\"\n", (s.directory / s.scripts() / "log" / pattern).string());
}

}  // namespace

std::string array_script(const Submission& s) {
  return "#!/bin/bash\n# One task of an array: its share of the work.\n# sbatch reads the lines that begin "
         "with #SBATCH.\n" +
         options_of(s, job_name(s)) + fmt::format("#SBATCH --array=1-{}\n", s.tasks) +
         log_of(s, "%A_%a.txt") + body(s) + "exit \"$status\"\n";
}

std::string finish_script(const Submission& s) {
  Submission last = s;
  if (!s.memory_to_collect.empty()) last.resources.memory = s.memory_to_collect;
  if (s.resources.seconds > 0) last.resources.seconds = std::max(s.resources.seconds, s.seconds_to_collect);
  std::string text = "#!/bin/bash\n# After all tasks: computes what they left, and collects the results.\n" +
                     options_of(last, job_name(s) + "-finish") + log_of(s, "%j.txt") + body(s);
  if (!s.afterwards.empty()) {
    text +=
        fmt::format("case $status in 0 | 5) {} || exit ;; esac  # 5: something is uncertain, and says so\n",
                    shell_quoted(s.afterwards));
  }
  return text + "exit \"$status\"\n";
}

std::string parallel_commands(const Submission& s) {
  std::string text;
  for (int number = 1; number <= s.tasks; ++number) {
    // Right after the subcommand: what follows may end with -- and names of files.
    std::vector<std::string> command = s.command;
    command.insert(command.begin() + 2, {"--shard", fmt::format("{}/{}", number, s.tasks), "--threads",
                                         std::to_string(s.resources.processors)});
    text += fmt::format("cd -- {} && {}\n", shell_quoted(s.directory.string()), shell_quoted(command));
  }
  return text;
}

std::string parallel_script(const Submission& s, int jobs) {
  const std::filesystem::path scripts = s.directory / s.scripts();
  std::string text = fmt::format(
      "#!/bin/bash\n"
      "# The shares of the work, {} at a time, by GNU parallel. Started again, it goes on with those that "
      "are "
      "open.\n"
      "# For other hosts that see the folder, add --sshlogin to it.\n"
      "cd -- {} || exit 3\n"
      "parallel --jobs {} --joblog {} --resume-failed < {}\n"
      "{} || [ $? = 5 ] || exit  # 5: something is uncertain, and says so\n",
      jobs, shell_quoted(s.directory.string()), jobs, shell_quoted((scripts / "joblog.txt").string()),
      shell_quoted((scripts / "commands.txt").string()), shell_quoted(s.command));
  if (!s.afterwards.empty()) text += shell_quoted(s.afterwards) + "\n";
  return text;
}

}  // namespace indet::app
