#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "apps/analyze_arguments.h"
#include "apps/batch/shard.h"
#include "apps/batch/work_status.h"
#include "apps/command.h"
#include "apps/ensemble_arguments.h"
#include "apps/output_files.h"
#include "apps/say.h"
#include "apps/shared_work.h"
#include "apps/shell.h"
#include "apps/slurm_time.h"
#include "apps/submission.h"
#include "apps/submitted_work.h"
#include "libindet/base/error.h"
#include "libindet/base/printable.h"
#include "libindet/io/destination.h"
#include "libindet/io/whole_file.h"

namespace indet::app {
namespace {

namespace fs = std::filesystem;

/// Of each task, where nothing else is said: long beside the start of a job, short beside a usual limit.
constexpr double kSecondsPerTask = 1800;
/// Estimates are of one machine, and packings differ.
constexpr double kTimeMargin = 3;
constexpr double kLeastTime = 600;
/// Slurm's default (slurm.conf(5)); the largest index is one less.
constexpr int kMaxArraySize = 1001;

struct SubmitCommand {
  EnsembleArguments ensemble;
  AnalyzeArguments analysis;
  std::string analysis_folder;
  std::optional<int> tasks;
  std::string engine = "slurm", time, memory_to_collect;
  TaskResources resources;
  std::optional<int> jobs;
  bool runs = false;
  bool no_report = false;
  bool overwrite = false;
};

/// The arguments that were given to a command, as words of a command line.
std::vector<std::string> words_of(const CLI::App& command) {
  std::vector<std::string> words, positional;
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() == 0 || option->get_lnames() == std::vector<std::string>{"help"}) continue;
    const std::vector<std::string> values = option->results();
    if (option->get_lnames().empty()) {
      positional.insert(positional.end(), values.begin(), values.end());
    } else if (option->get_expected_max() == 0) {
      if (values.front() != "false") words.push_back("--" + option->get_lnames().front());
    } else {
      words.push_back("--" + option->get_lnames().front());
      if (option->get_delimiter() != '\0') {
        words.push_back(fmt::format("{}", fmt::join(values, std::string(1, option->get_delimiter()))));
      } else {
        words.insert(words.end(), values.begin(), values.end());
      }
    }
  }
  if (!positional.empty()) {
    words.emplace_back("--");
    words.insert(words.end(), positional.begin(), positional.end());
  }
  return words;
}

/// A newline would begin another line of the script.
void require_one_line(const std::string& option, const std::string& value) {
  if (std::none_of(value.begin(), value.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }))
    return;
  throw UsageError(fmt::format("{} {}: must be one line", option, excerpt(value)));
}

/// MaxArraySize of the cluster, where it can be asked.
int largest_array() {
  const std::string line =
      first_line_of("timeout 20 scontrol show config 2>/dev/null | grep -i '^MaxArraySize'");
  const std::size_t digits = line.find_first_of("0123456789");
  int size = kMaxArraySize;
  if (digits != std::string::npos) std::from_chars(line.data() + digits, line.data() + line.size(), size);
  return std::max(1, size - 1);
}

struct Scripts {
  std::vector<FileText> files;
  std::string how;  ///< The command that starts them.
};

Scripts scripts_of(const Submission& submission, const SubmitCommand& o) {
  const fs::path folder = submission.scripts();
  if (o.engine == "parallel") {
    const fs::path script = folder / "run.sh";
    return {{{script, parallel_script(submission, o.jobs.value_or(submission.tasks))},
             {folder / "commands.txt", parallel_commands(submission)}},
            "bash " + shell_quoted(script.string())};
  }
  const fs::path array = folder / "array.sh", finish = folder / "finish.sh";
  return {{{array, array_script(submission)}, {finish, finish_script(submission)}},
          fmt::format("job=$(sbatch --parsable {}) && sbatch --dependency=afterany:$job {}",
                      shell_quoted(array.string()), shell_quoted(finish.string()))};
}

/// Returns the number of the job that sbatch has made.
std::string submit(const std::string& options, const fs::path& script) {
  const std::string said =
      first_line_of(fmt::format("sbatch --parsable {} {} 2>&1", options, shell_quoted(script.string())));
  const std::string job = said.substr(0, said.find(';'));  // JOB;CLUSTER
  const bool is_number = !job.empty() && job.find_first_not_of("0123456789") == std::string::npos;
  if (!is_number)
    throw LibraryError(
        fmt::format("sbatch did not take {}: {}", script.string(), said.empty() ? "it said nothing" : said));
  return job;
}

std::vector<std::string> start(const Scripts& scripts, const SubmitCommand& o, const Context& context) {
  if (o.engine == "parallel") {
    const std::string output = context.json ? " >&2" : context.quiet ? " >/dev/null" : "";
    if (std::system((scripts.how + output).c_str()) != 0) throw LibraryError(scripts.how + " failed");
    return {};
  }
  const std::string array = submit("", scripts.files[0].path);
  return {array, submit("--dependency=afterany:" + array, scripts.files[1].path)};
}

/// Two that do the same work harm nobody, but the account.
void warn_of_others(const SubmittedWork& work, const Context& context) {
  const WorkStatus status = status_of(work.folder, shared_work_of(work.folder).expected);
  const auto alive =
      std::count_if(status.tasks.begin(), status.tasks.end(), [](const auto& task) { return task.is_alive; });
  if (alive == 0) return;
  context.warn(
      fmt::format("{} already at work in {} (indet status tells which); what they have in hand is "
                  "computed twice",
                  alive == 1 ? "1 process is" : fmt::format("{} processes are", alive), work.folder));
}

void check(const SubmitCommand& o) {
  const TaskResources& asked = o.resources;
  for (const auto& [option, value] : {std::pair<std::string, std::string>{"--partition", asked.partition},
                                      {"--account", asked.account},
                                      {"--mem", asked.memory},
                                      {"--mem-to-collect", o.memory_to_collect},
                                      {"--time", o.time}})
    require_one_line(option, value);
  for (const std::string& line : asked.lines) require_one_line("--line", line);
  if (o.jobs && o.engine != "parallel")
    throw UsageError("--jobs has no effect without --engine parallel, which runs so many tasks at a time");
}

double seconds_of(const SubmittedWork& work) {
  return std::accumulate(work.costs.begin(), work.costs.end(), 0.0);
}

int tasks_for(const SubmittedWork& work, const SubmitCommand& o) {
  const int groups = static_cast<int>(std::ssize(work.costs));
  const int most = std::min(groups, o.engine == "slurm" ? largest_array() : groups);
  if (!o.tasks) {
    const double wanted = std::ceil(seconds_of(work) / (kSecondsPerTask * o.resources.processors));
    return static_cast<int>(std::clamp<double>(wanted, 1, most));
  }
  if (*o.tasks <= most) return *o.tasks;
  throw UsageError(fmt::format(
      "--tasks {}: {}", *o.tasks,
      most == groups ? fmt::format("there are {} to deal", counted(groups, work.group, work.groups))
                     : fmt::format("an array of this cluster has at most {}", most)));
}

double time_limit_for(double longest_share, const SubmitCommand& o) {
  if (o.time.empty()) return std::max(kLeastTime, kTimeMargin * longest_share);
  const auto seconds = seconds_from(o.time);
  if (seconds && *seconds > 0) return *seconds;
  throw UsageError(fmt::format(
      "--time {}: expected MINUTES, HOURS:MINUTES:SECONDS or DAYS-HOURS:MINUTES:SECONDS", excerpt(o.time)));
}

/// `command`: the one below submit, with the options of what is submitted.
int run(const SubmitCommand& o, const SubmittedWork& work, const CLI::App& command, const Context& context) {
  require_one_line("--out", work.folder);
  Submission submission{.directory = fs::current_path(),
                        .folder = work.folder,
                        .command = {fs::read_symlink("/proc/self/exe").string(), work.subcommand},
                        .afterwards = {},
                        .tasks = tasks_for(work, o),
                        .resources = o.resources,
                        .memory_to_collect = o.memory_to_collect,
                        .seconds_to_collect = kLeastTime + work.seconds_to_collect};
  const std::vector<std::string> words = words_of(command);
  submission.command.insert(submission.command.end(), words.begin(), words.end());
  if (!o.no_report && !work.afterwards.empty()) {
    submission.afterwards = work.afterwards;
    submission.afterwards.insert(submission.afterwards.begin(), submission.command.front());
  }
  const double longest =
      std::ranges::max(costs_of_shares(work.costs, submission.tasks)) / o.resources.processors;
  submission.resources.seconds = time_limit_for(longest, o);

  const Scripts scripts = scripts_of(submission, o);
  make_folder(submission.scripts() / "log");
  work.write_plan();
  write_whole_files(scripts.files);
  if (o.runs) warn_of_others(work, context);
  const std::vector<std::string> jobs = o.runs ? start(scripts, o, context) : std::vector<std::string>();

  if (context.json) {
    nlohmann::json files = nlohmann::json::array();
    for (const FileText& file : scripts.files) files.push_back(file.path.string());
    std::cout << nlohmann::json{{"folder", work.folder},
                                {"items", work.items},
                                {"tasks", submission.tasks},
                                {"seconds", seconds_of(work)},
                                {"longest_share", longest},
                                {"time_limit", submission.resources.seconds},
                                {"scripts", files},
                                {"start", scripts.how},
                                {"jobs", jobs}}
                     .dump(2)
              << '\n';
  } else if (context.prints_report()) {
    if (!o.runs) {
      for (const FileText& file : scripts.files) say("# {}\n{}\n", file.path.string(), file.bytes);
    }
    say("{}, about {:.0f} s of work, in {} of at most {:.0f} s\n", counted(work.items, work.item),
        seconds_of(work), counted(submission.tasks, "task"), longest);
    if (!o.runs) {
      say("nothing was started; to start it: {}\n", scripts.how);
    } else if (!jobs.empty()) {
      say("submitted as jobs {} (the tasks) and {} (which collects)\n", jobs[0], jobs[1]);
    }
    say("to look at it: indet status {}\n", shell_quoted(work.folder));
  }
  return kDone;
}

}  // namespace

Command add_submit(CLI::App& root) {
  const auto o = std::make_shared<SubmitCommand>();
  CLI::App* command = root.add_subcommand(
      "submit", "Write the scripts with which a cluster does the work of another subcommand, and start them");
  command->require_subcommand(1);
  command
      ->add_option("--tasks", o->tasks,
                   "Number of tasks (default: so many that each takes about half an hour)")
      ->check(CLI::PositiveNumber);
  command
      ->add_option(
          "--engine", o->engine,
          "slurm: an array of tasks, and a job that collects; parallel: GNU parallel, on this machine")
      ->check(CLI::IsMember({"slurm", "parallel"}))
      ->capture_default_str();
  command->add_flag("--run", o->runs, "Start it (default: only write the scripts, and print them)");
  command->add_option("--partition", o->resources.partition, "slurm: partition (default: the cluster's)");
  command->add_option("--account", o->resources.account, "slurm: account");
  command->add_option("--time", o->time,
                      "slurm: time limit of a task, as sbatch takes it (default: three times the estimate)");
  command->add_option("--cpus", o->resources.processors, "Processors of each task")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option(
      "--mem-to-collect", o->memory_to_collect,
      "slurm: memory of the job that collects, 13G for 100 000 packings of 95 disks (default: --mem)");
  command->add_option("--mem", o->resources.memory,
                      "slurm: memory of a task, as 2G (default: the cluster's)");
  command->add_option("--line", o->resources.lines,
                      "slurm: a further option of sbatch, as --line=--constraint=avx2; may be repeated");
  command->add_option("--jobs", o->jobs, "parallel: tasks at a time (default: all of them)")
      ->check(CLI::PositiveNumber);
  command->add_flag("--no-report", o->no_report, "Do not make the report in the end");
  add_overwrite_option(*command, o->overwrite);
  CLI::App* ensemble = command->add_subcommand(
      "ensemble", "The packings of an ensemble, with the options of indet ensemble; seeds are dealt");
  add_ensemble_options(*ensemble, o->ensemble);
  ensemble->fallthrough();
  CLI::App* analyze = command->add_subcommand(
      "analyze", "The ranges of one large packing, with the options of indet analyze; contacts are dealt");
  analyze->add_option("--out", o->analysis_folder, "Folder in which the tasks share the work")
      ->required()
      ->type_name("FOLDER");
  add_analyze_options(*analyze, o->analysis);
  analyze->fallthrough();
  return {command, [o, ensemble, analyze](const Context& context) {
            check(*o);
            if (analyze->parsed()) {
              return run(*o, submitted_analysis(o->analysis, o->analysis_folder, o->overwrite, context),
                         *analyze, context);
            }
            return run(*o, submitted_ensemble(o->ensemble, o->overwrite, context), *ensemble, context);
          }};
}

}  // namespace indet::app
