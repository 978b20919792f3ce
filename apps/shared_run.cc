#include "apps/shared_run.h"

#include <fmt/format.h>

#include <iostream>
#include <string>
#include <utility>

#include "apps/interruption.h"
#include "apps/say.h"
#include "apps/scheduler.h"

namespace indet::app {

BatchSummary run_with_log(const std::filesystem::path& folder, TaskRecord record, const Context& context,
                          const std::function<BatchSummary(TaskLog&)>& work) {
  record.job = scheduler_job();
  record.threads = context.thread_count();
  TaskLog log(folder, std::move(record), [&context](const std::string& text) { context.warn(text); });
  set_last_act([&log] { log.end("stopped"); });
  try {
    BatchSummary summary = work(log);
    log.end(summary.is_interrupted      ? "stopped"
            : summary.out_of_time > 0   ? "out of time"
            : !summary.failures.empty() ? "failed"
                                        : "done");
    set_last_act({});  // only now: the program may be ended at any moment
    return summary;
  } catch (...) {
    log.end("failed");
    set_last_act({});
    throw;
  }
}

ProgressCallback shared_progress(const Context& context) {
  return [show = context.progress()](const Progress& progress) {
    set_remains(fmt::format("done: {}; the same command goes on", progress.details));
    return show(progress);
  };
}

int report_share(const ShareReport& report, const BatchSummary& summary, double seconds,
                 const Context& context) {
  if (context.json) {
    std::cout << nlohmann::json{{"folder", report.folder.string()},
                                {"part", report.part},
                                {"done", summary.done},
                                {"skipped", summary.there_already},
                                {"out_of_time", summary.out_of_time},
                                {"failures", to_json(summary.failures, report.item)},
                                {"seconds", seconds}}
                     .dump(2)
              << '\n';
  } else if (context.prints_report()) {
    const std::string left =
        summary.out_of_time > 0 ? fmt::format(", {} left for want of time", summary.out_of_time) : "";
    say("{}: {} computed, {} there already, {} failed{} ({:.1f} s)\n",
        report.part.empty() ? "all" : report.part, summary.done, summary.there_already,
        summary.failures.size(), left, seconds);
    const bool is_open = summary.out_of_time > 0 || !summary.failures.empty();
    say("{}\n", is_open ? "the same command goes on" : report.next);
  }
  if (summary.out_of_time > 0) return kOutOfTime;
  return summary.failures.empty() ? kDone : kUncertain;
}

nlohmann::json to_json(const std::vector<ItemFailure>& failures, const std::string& item) {
  nlohmann::json json = nlohmann::json::array();
  for (const ItemFailure& failure : failures)
    json.push_back({{item, failure.item}, {"reason", failure.reason}});
  return json;
}

}  // namespace indet::app
