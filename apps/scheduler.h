#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "apps/batch/shard.h"
#include "apps/command.h"

namespace indet::app {

/// What Slurm tells the tasks that it starts, by environment variables (sbatch(1)).

/// Share of this task among those of its array, or nothing outside of one. Throws UsageError where the array
/// has gaps, which hide how many shares there are.
std::optional<Shard> shard_of_array();

/// "117_3 on node2", "118"; empty outside of a job.
std::string scheduler_job();

/// Processors of this task, or nothing where none were asked for.
std::optional<int> processors_of_task();

/// Seconds until the job reaches its time limit; nothing outside of a job, or without a limit.
std::optional<double> seconds_of_job_left();

/// The options of work that several tasks share.
struct ShareArguments {
  std::string shard;
  std::optional<double> time_budget;
};

/// `work`: what is dealt, for the help text. `arguments` must outlive the command.
void add_share_options(CLI::App& command, const std::string& work, ShareArguments& arguments);

/// The share that was asked for, else that of the task of an array; nothing: all of it. Throws UsageError.
std::optional<Shard> share_of(const ShareArguments& arguments, const Context& context);

/// Seconds for work: what was asked for, else what is left of the job, less the time for its end.
std::optional<double> time_budget_of(const ShareArguments& arguments);

}  // namespace indet::app
