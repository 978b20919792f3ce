#include "apps/analyze_in_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>

#include "apps/analysis_parts/chunk_file.h"
#include "apps/analysis_parts/folder.h"
#include "apps/analysis_parts/plan.h"
#include "apps/analysis_parts/run.h"
#include "apps/interruption.h"
#include "apps/output_files.h"
#include "apps/packing_input.h"
#include "apps/shared_run.h"
#include "apps/trial_reading.h"
#include "libindet/base/error.h"
#include "libindet/base/stopwatch.h"
#include "libindet/io/destination.h"
#include "libindet/io/ranges_file.h"
#include "libindet/range/dealt_analysis.h"

namespace indet::app {
namespace {

namespace fs = std::filesystem;

void read_chunk(const fs::path& path) { read_ranges(open_indet_file(path)); }

PartsOptions parts_options(const ShareArguments& share, TaskLog& log, const Context& context) {
  PartsOptions options;
  options.threads = context.thread_count();
  options.progress = shared_progress(context);
  options.time_budget = time_budget_of(share);
  options.log = &log;
  options.provenance = {context.arguments, context.resolved_config, {}, {}};
  return options;
}

int join(const AnalysisPlan& plan, const std::vector<fs::path>& folders, const fs::path& output,
         const Context& context) {
  const JoinedAnalysis joined = join_chunks(plan, folders, context.progress());
  write_ranges(output, joined.packing, joined.ranges, {context.arguments, context.resolved_config, {}, {}});
  return report_ranges(joined.packing, joined.ranges, output.string(), context);
}

}  // namespace

void claim_parts_folder(const fs::path& folder, const AnalysisPlan& plan, const Replacement& rule,
                        bool overwrite) {
  if (!fs::is_directory(folder)) return;
  rule.require(folder / "analysis.toml", FileKind::kAnalysisPlan);
  rule.require(joined_path(folder), FileKind::kRanges);
  const bool is_own = has_analysis_plan(folder);
  for (const fs::path& path : chunk_paths(folder, plan)) {
    if (!fs::is_regular_file(path)) continue;
    if (is_own) {
      rule.require_unread(path);  // a damaged one is computed again
    } else {
      rule.require(path, FileKind::kRanges);
    }
  }
  if (overwrite || !is_own) return;
  const AnalysisPlan there = read_analysis_plan(folder);
  if (there.hash() == plan.hash()) return;
  const std::string difference = there.packing != plan.packing   ? "is of another packing"
                                 : there.version != plan.version ? "was begun by another version of indet"
                                                                 : "has other options";
  throw InputError(fmt::format(
      "{} holds an analysis that {}; take another folder, or --overwrite to begin again in this one",
      folder.string(), difference));
}

PlannedAnalysis plan_in_parts(const AnalyzeArguments& arguments, const Context& context) {
  const Hdf5File file = open_packing(arguments.packing);
  PlannedAnalysis planned;
  planned.packing = packing_of(file, arguments);
  planned.options = resolve(arguments, planned.packing, context);
  if (is_exact(arguments.analysis)) planned.options.exactness = AnalyzeOptions::Exactness::kEverywhere;
  const int contacts = planned.packing.contact_count();
  if (const auto obstacle = obstacle_to_dealing(planned.options, contacts))
    throw UsageError(fmt::format("--out deals contacts to processes: {}", *obstacle));
  planned.plan = make_analysis_plan(packing_digest(file), contacts, planned.options, arguments.conditions);
  return planned;
}

int analyze_in_parts(const AnalyzeArguments& arguments, const fs::path& folder, const ShareArguments& share,
                     bool overwrite, const Context& context) {
  const Stopwatch watch;
  const auto [packing, analysis, plan] = plan_in_parts(arguments, context);
  std::optional<Shard> shard = share_of(share, context);
  if (shard && shard->count == 1) shard.reset();
  try_reading(chunk_paths(folder, plan), read_chunk);
  claim_parts_folder(folder, plan, replacement_rule({arguments.packing}, overwrite, context), overwrite);
  const std::vector<Chunk> share_of_chunks = shard ? chunks_of(plan, *shard) : plan.chunks;
  const std::vector<Chunk> open =
      open_chunks(plan, share_of_chunks, folder, [&](const std::string& text) { context.warn(text); });
  std::optional<DealtAnalysis> dealt;
  if (!open.empty()) dealt.emplace(packing, analysis);  // before anything is written, for it may refuse
  make_folder(chunks_folder(folder));
  write_analysis_plan(folder, plan);

  const std::string name = shard ? "shard " + shard->name() : "";
  BatchSummary summary;
  summary.there_already = std::ssize(share_of_chunks) - std::ssize(open);
  if (dealt) {
    summary = run_with_log(folder, {.work = plan.hash(), .shard = name}, context, [&](TaskLog& log) {
      PartsOptions options = parts_options(share, log, context);
      options.there_already = summary.there_already;
      return compute_chunks(packing, *dealt, plan, open, folder, options);
    });
  }
  for (const ItemFailure& failure : summary.failures)
    context.warn(fmt::format("{}: {}", failure.item, failure.reason));
  if (summary.is_interrupted) return stopped();
  if (shard || summary.out_of_time > 0 || !summary.failures.empty()) {
    return report_share(
        {folder, "part", name, "once all shards are done, the same command without --shard joins the parts"},
        summary, watch.seconds(), context);
  }
  return join(plan, {folder}, joined_path(folder), context);
}

int merge_analysis(const std::vector<fs::path>& folders, const fs::path& output, bool overwrite,
                   const Context& context) {
  const AnalysisPlan plan = read_analysis_plan(folders.front());
  for (const fs::path& folder : folders) {
    if (read_analysis_plan(folder).hash() != plan.hash()) {
      throw InputError(fmt::format("{} and {} hold parts of different analyses", folders.front().string(),
                                   folder.string()));
    }
  }
  std::vector<fs::path> paths;
  for (const fs::path& folder : folders) {
    const std::vector<fs::path> some = chunk_paths(folder, plan);
    paths.insert(paths.end(), some.begin(), some.end());
  }
  claim_output(output, FileKind::kRanges, replacement_rule(paths, overwrite, context));
  try_reading(paths, read_chunk);
  return join(plan, folders, output, context);
}

}  // namespace indet::app
