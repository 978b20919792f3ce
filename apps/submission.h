#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace indet::app {

/// What a batch system is asked for.
struct TaskResources {
  int processors = 1;                      ///< Of each task.
  double seconds = 0;                      ///< Time limit of each task; 0: that of the partition.
  std::string memory, partition, account;  ///< As sbatch takes them; empty: its default.
  std::vector<std::string> lines;          ///< Further options of sbatch, "--constraint=avx2".
};

/// Work in a folder that tasks share, to be handed to a batch system.
struct Submission {
  std::filesystem::path directory;      ///< Where the program is to run.
  std::filesystem::path folder;         ///< FOLDER of the work, as the program is given it.
  std::vector<std::string> command;     ///< The program, its subcommand and arguments; no --shard.
  std::vector<std::string> afterwards;  ///< What follows once all is collected; may be empty.
  int tasks = 1;
  TaskResources resources;
  std::string memory_to_collect;  ///< Of the last job; empty: as of the tasks.
  double seconds_to_collect = 0;  ///< Of the last job, which cannot be cut; its limit is not below that.

  std::filesystem::path scripts() const { return folder / "cluster"; }
};

/// The scripts for sbatch: one for each task of an array, and one that computes what the tasks left,
/// collects, and goes on with `afterwards`.
std::string array_script(const Submission& submission);
std::string finish_script(const Submission& submission);

/// For GNU parallel: a script, and the commands that it runs, one a line.
std::string parallel_script(const Submission& submission, int jobs);
std::string parallel_commands(const Submission& submission);

}  // namespace indet::app
