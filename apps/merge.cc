#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "apps/analysis_parts/folder.h"
#include "apps/analyze_in_parts.h"
#include "apps/command.h"
#include "apps/ensemble/members/folder.h"
#include "apps/ensemble/members/member_file.h"
#include "apps/ensemble/tables/collect.h"
#include "apps/ensemble_output.h"
#include "apps/output_files.h"
#include "apps/trial_reading.h"
#include "libindet/base/error.h"
#include "libindet/io/destination.h"
#include "libindet/io/whole_file.h"

namespace indet::app {
namespace {

namespace fs = std::filesystem;

struct MergeCommand {
  std::vector<std::string> parts;
  std::string output;
  bool allow_missing = false;
  bool overwrite = false;
};

int run(const MergeCommand& o, const Context& context) {
  const auto begin = std::chrono::steady_clock::now();
  std::vector<fs::path> parts(o.parts.begin(), o.parts.end());
  if (has_analysis_plan(parts.front())) {
    if (o.allow_missing)
      throw UsageError(
          "--allow-missing has no effect on an analysis, whose ranges are those of all contacts");
    return merge_analysis(parts, o.output, o.overwrite, context);
  }
  const Plan plan = read_plan(parts.front());
  for (const fs::path& part : parts) {
    if (read_plan(part).hash() != plan.hash()) {
      throw InputError(
          fmt::format("{} and {} are parts of different ensembles", parts.front().string(), part.string()));
    }
  }
  const fs::path folder = o.output;
  claim_folder(folder, plan.members, replacement_rule({}, o.overwrite, context));
  // What an earlier merge brought there is the same file under two names.
  std::vector<fs::path> folders = parts;
  if (fs::exists(folder / "ensemble.toml") && recognise(folder / "ensemble.toml") == FileKind::kPlan) {
    if (read_plan(folder).hash() != plan.hash())
      throw InputError(fmt::format("{} holds another ensemble", folder.string()));
    const bool listed = std::any_of(parts.begin(), parts.end(),
                                    [&](const fs::path& part) { return fs::equivalent(part, folder); });
    if (!listed) folders.push_back(folder);
  }
  try_reading(member_paths(folders, plan.members), read_member);
  Collection collection = collect_members(plan, folders, context.progress());
  const std::vector<MissingMember>& missing = collection.missing;
  if (!missing.empty() && !o.allow_missing) {
    std::string list;
    for (const MissingMember& m : missing)
      list += "\n  " + m.member + (m.reason.empty() ? "" : " (" + m.reason + ")");
    throw InputError(fmt::format("{} of {} members {} missing (--allow-missing joins the others):{}",
                                 missing.size(), plan.members.size(), missing.size() == 1 ? "is" : "are",
                                 list));
  }
  make_folder(members_folder(folder));
  remove_leftovers(folder);
  remove_leftovers(members_folder(folder));
  write_plan(folder, plan);
  BatchSummary summary;
  for (const Member& member : plan.members) {
    for (const fs::path& part : folders) {
      const fs::path from = member_path(part, member.name);
      if (!member_is_done(from, member)) continue;
      ++summary.there_already;
      if (!member_is_done(member_path(folder, member.name), member))
        link_whole_file(from, member_path(folder, member.name));
      break;
    }
  }
  const auto seconds = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  return finish_ensemble(folder, plan, std::move(collection), summary, seconds, context);
}

}  // namespace

Command add_merge(CLI::App& root) {
  const auto o = std::make_shared<MergeCommand>();
  CLI::App* command = root.add_subcommand(
      "merge", "Join the parts of an ensemble that indet ensemble --members computed, or of an analysis");
  command
      ->add_option("parts", o->parts,
                   "Folders of the parts, that indet ensemble or indet analyze --out wrote")
      ->required()
      ->check(CLI::ExistingDirectory);
  command
      ->add_option("-o,--out", o->output, "Folder to write for an ensemble, file R.ranges.h5 for an analysis")
      ->required();
  command->add_flag("--allow-missing", o->allow_missing,
                    "Join the parts even if some packings are in none of them");
  add_overwrite_option(*command, o->overwrite);
  return {command, [o](const Context& context) { return run(*o, context); }};
}

}  // namespace indet::app
