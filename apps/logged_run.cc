#include "apps/logged_run.h"

#include <string>
#include <utility>

#include "apps/interruption.h"
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

}  // namespace indet::app
