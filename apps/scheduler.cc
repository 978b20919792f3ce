#include "apps/scheduler.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <ctime>

#include "apps/numbers.h"
#include "apps/shell.h"
#include "apps/slurm_time.h"
#include "libindet/base/printable.h"

namespace indet::app {
namespace {

/// Between the end of the work and that of the job: Slurm's clock ticks in half minutes, and the script of
/// `indet submit` is signalled 75 s before the end.
constexpr double kReserve = 90;

std::string text_of(const char* variable) {
  const char* const text = std::getenv(variable);
  return text == nullptr ? "" : text;
}

std::optional<std::int64_t> number_of(const char* variable) {
  const std::string text = text_of(variable);
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (text.empty() || error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

}  // namespace

std::optional<Shard> shard_of_array() {
  const auto task = number_of("SLURM_ARRAY_TASK_ID"), first = number_of("SLURM_ARRAY_TASK_MIN"),
             last = number_of("SLURM_ARRAY_TASK_MAX"), count = number_of("SLURM_ARRAY_TASK_COUNT");
  if (!task || !first || !last || !count) return std::nullopt;
  const std::int64_t step = std::max<std::int64_t>(1, number_of("SLURM_ARRAY_TASK_STEP").value_or(1));
  if ((*last - *first) / step + 1 != *count || (*task - *first) % step != 0) {
    throw UsageError(
        fmt::format("the array of this Slurm job has gaps ({} tasks from {} to {}), so that it does not say "
                    "which share is this task's; give --shard K/N",
                    *count, *first, *last));
  }
  return Shard{static_cast<int>((*task - *first) / step) + 1, static_cast<int>(*count)};
}

std::string scheduler_job() {
  const std::string array = text_of("SLURM_ARRAY_JOB_ID"), task = text_of("SLURM_ARRAY_TASK_ID");
  std::string job = !array.empty() && !task.empty() ? array + "_" + task : text_of("SLURM_JOB_ID");
  const std::string node = text_of("SLURMD_NODENAME");
  if (!job.empty() && !node.empty()) job += " on " + node;
  return job;
}

std::optional<int> processors_of_task() {
  const auto processors = number_of("SLURM_CPUS_PER_TASK");
  if (!processors || *processors < 1) return std::nullopt;
  return static_cast<int>(*processors);
}

std::optional<double> seconds_of_job_left() {
  const auto job = number_of("SLURM_JOB_ID");
  if (!job) return std::nullopt;
  if (const auto end = number_of("SLURM_JOB_END_TIME"))  // of Slurm 23.02
    return std::max(0.0, static_cast<double>(*end - std::time(nullptr)));
  return seconds_from(first_line_of(fmt::format("timeout 20 squeue -h -j {} -o %L 2>/dev/null", *job)));
}

void add_share_options(CLI::App& command, const std::string& work, ShareArguments& arguments) {
  command
      .add_option(
          "--shard", arguments.shard,
          fmt::format("Do the K-th of N shares of the {}, which N processes do together in one folder "
                      "(default: in a task of a Slurm array, its share; else all)",
                      work))
      ->type_name("K/N");
  command
      .add_option("--time-budget", arguments.time_budget,
                  "Start nothing but the first that will probably not be finished within this many seconds; "
                  "0: no limit (default: in a Slurm job, what is left of its time limit)")
      ->type_name("SECONDS")
      ->check(not_negative());
}

std::optional<Shard> share_of(const ShareArguments& arguments, const Context& context) {
  if (!arguments.shard.empty()) {
    const std::optional<Shard> shard = shard_from(arguments.shard);
    if (!shard) {
      throw UsageError(
          fmt::format("--shard {}: expected K/N, as 3/8, with K from 1 to N", excerpt(arguments.shard)));
    }
    return shard;
  }
  const std::optional<Shard> shard = shard_of_array();
  if (shard) {
    context.note(fmt::format("--shard {}, as this is task {} of a Slurm array; --shard 1/1 does all of it",
                             shard->name(), text_of("SLURM_ARRAY_TASK_ID")));
  }
  return shard;
}

std::optional<double> time_budget_of(const ShareArguments& arguments) {
  if (arguments.time_budget) {
    if (*arguments.time_budget == 0) return std::nullopt;
    return arguments.time_budget;
  }
  const std::optional<double> left = seconds_of_job_left();
  if (!left) return std::nullopt;
  return std::max(0.0, *left - kReserve);
}

}  // namespace indet::app
