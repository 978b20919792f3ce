#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>

#include "apps/batch/work_status.h"
#include "apps/command.h"
#include "apps/interruption.h"
#include "apps/numbers.h"
#include "apps/say.h"
#include "apps/shared_work.h"

namespace indet::app {
namespace {

using Item = WorkStatus::Item;

struct StatusCommand {
  std::string folder;
  std::optional<int> tasks;
  bool watch = false;
};

/// "3 s", "12 min", "5.0 h".
std::string duration(double seconds) {
  if (seconds < 120) return fmt::format("{:.0f} s", seconds);
  if (seconds < 7200) return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.1f} h", seconds / 3600);
}

std::string name_of(const WorkStatus::Task& task) {
  const TaskRecord& record = task.record;
  std::string name = fmt::format("process {} on {}", record.process, record.host);
  if (!record.job.empty()) name += ", job " + record.job;
  if (!record.shard.empty()) name += ", " + record.shard;
  return name;
}

/// How many tasks what is left is reckoned for, of how many threads: those asked for, else those that run,
/// else one.
struct Workers {
  int tasks = 1;
  int threads = 1;
};

Workers workers_of(const WorkStatus& status, const std::optional<int>& asked, const Context& context) {
  Workers workers{0, 0};
  for (const WorkStatus::Task& task : status.tasks) {
    if (!task.is_alive) continue;
    ++workers.tasks;
    workers.threads = std::max(workers.threads, task.record.threads);
  }
  if (workers.tasks == 0) workers = {1, context.threads > 0 ? context.threads : 1};
  if (asked) workers.tasks = *asked;
  return workers;
}

nlohmann::json to_json(const SharedWork& work, const WorkStatus& status, const Workers& workers) {
  nlohmann::json tasks = nlohmann::json::array(), failures = tasks, missing = tasks;
  for (const WorkStatus::Task& task : status.tasks) {
    nlohmann::json in_hand = nlohmann::json::array();
    for (const TaskRecord::ItemInHand& item : task.record.in_hand)
      in_hand.push_back({{"name", item.name}, {"since", item.since}});
    tasks.push_back({{"host", task.record.host},
                     {"process", task.record.process},
                     {"job", task.record.job},
                     {"part", task.record.shard},
                     {"alive", task.is_alive},
                     {"silent", task.silent},
                     {"in_hand", in_hand}});
  }
  for (const ItemFailure& failure : status.failures)
    failures.push_back({{"name", failure.item}, {"reason", failure.reason}});
  for (std::size_t i = 0; i < status.items.size(); ++i) {
    if (status.items[i] == Item::kMissing) missing.push_back(work.expected.items[i].name);
  }
  return {{"folder", work.folder.string()},
          {"kind", work.kind},
          {"items", status.items.size()},
          {"done", status.count(Item::kDone)},
          {"running", status.count(Item::kRunning)},
          {"stale", status.count(Item::kStale)},
          {"failed", status.count(Item::kFailed)},
          {"missing", status.count(Item::kMissing)},
          {"names_missing", missing},
          {"tasks", tasks},
          {"failures", failures},
          {"starts", status.starts},
          {"collected", work.is_collected},
          {"seconds", status.seconds},
          {"seconds_left", status.left},
          {"reckoned_for", {{"tasks", workers.tasks}, {"threads", workers.threads}}},
          {"seconds_left_on_these", status.seconds_on(workers.tasks, workers.threads)}};
}

void print_tasks(const WorkStatus& status) {
  constexpr std::size_t kShown = 30;
  std::size_t shown = 0;
  const std::int64_t now =
      std::chrono::duration_cast<std::chrono::seconds>(std::chrono::system_clock::now().time_since_epoch())
          .count();
  for (const WorkStatus::Task& task : status.tasks) {
    if (++shown > kShown) continue;
    std::string items;
    for (const TaskRecord::ItemInHand& item : task.record.in_hand) {
      items += fmt::format("{}{} for {}", items.empty() ? "" : ", ", item.name,
                           duration(static_cast<double>(std::max<std::int64_t>(0, now - item.since))));
    }
    if (items.empty()) items = "between two";
    if (task.is_alive) {
      say("running  {}: {}\n", name_of(task), items);
    } else {
      say("stale    {}, silent for {}: {}\n", name_of(task), duration(task.silent), items);
    }
  }
  if (shown > kShown) say("         and {} more processes\n", shown - kShown);
  shown = 0;
  for (const ItemFailure& failure : status.failures) {
    if (++shown <= kShown) say("failed   {}: {}\n", failure.item, failure.reason);
  }
  if (shown > kShown) say("         and {} more\n", shown - kShown);
}

void print(const SharedWork& work, const WorkStatus& status, const Workers& workers) {
  say("{}: {} done, {} running, {} stale, {} failed, {} missing\n",
      counted(std::ssize(status.items), work.item, work.items), status.count(Item::kDone),
      status.count(Item::kRunning), status.count(Item::kStale), status.count(Item::kFailed),
      status.count(Item::kMissing));
  print_tasks(status);
  std::string stages;
  for (const auto& [stage, seconds] : status.seconds)
    stages += fmt::format("{}{} {:.1f} s", stages.empty() ? "" : ", ", stage, seconds);
  if (!stages.empty()) say("by stage, of {}: {}\n", counted(status.starts, "process", "processes"), stages);
  if (status.count(Item::kDone) < std::ssize(status.items)) {
    say("left: about {} of work, {} on {} of {}\n", duration(status.left),
        duration(status.seconds_on(workers.tasks, workers.threads)), counted(workers.tasks, "task"),
        counted(workers.threads, "thread"));
  } else if (work.is_collected) {
    say("collected in {}\n", work.result.string());
  } else {
    say("to be collected by {}\n", work.collector);
  }
}

int run(const StatusCommand& o, const Context& context) {
  using namespace std::chrono_literals;
  const SharedWork work = shared_work_of(o.folder);
  for (bool is_first = true;; is_first = false) {
    const WorkStatus status = status_of(work.folder, work.expected);
    const Workers workers = workers_of(status, o.tasks, context);
    if (is_first) {
      for (const std::string& warning : status.warnings) context.warn(warning);
    }
    if (context.json) {
      std::cout << to_json(work, status, workers).dump(o.watch ? -1 : 2) << std::endl;
    } else if (context.prints_report()) {
      if (o.watch && isatty(STDOUT_FILENO) == 1) say("\x1b[H\x1b[2J");
      print(work, status, workers);
      std::fflush(stdout);
    }
    const bool is_open = status.count(Item::kDone) < std::ssize(status.items);
    if (!o.watch || !is_open) return kDone;
    for (int i = 0; i < 20; ++i) {
      if (caught_signal() != 0) return stopped();
      std::this_thread::sleep_for(100ms);
    }
  }
}

}  // namespace

Command add_status(CLI::App& root) {
  const auto o = std::make_shared<StatusCommand>();
  CLI::App* command =
      root.add_subcommand("status", "Tell how the work stands that processes do together in a folder");
  command->add_option("folder", o->folder, "Folder that indet ensemble writes")
      ->required()
      ->check(CLI::ExistingDirectory);
  command
      ->add_option("--tasks", o->tasks,
                   "Say how long what is left takes on this many tasks (default: those that run)")
      ->check(CLI::PositiveNumber);
  command->add_flag("--watch", o->watch, "Say it anew every two seconds, until all is done");
  return {command, [o](const Context& context) { return run(*o, context); }};
}

}  // namespace indet::app
