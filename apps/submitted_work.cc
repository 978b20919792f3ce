#include "apps/submitted_work.h"

#include <filesystem>
#include <memory>

#include "apps/analysis_parts/folder.h"
#include "apps/analysis_parts/run.h"
#include "apps/analyze_in_parts.h"
#include "apps/ensemble/members/folder.h"
#include "apps/ensemble/members/plan.h"
#include "apps/ensemble_output.h"
#include "apps/output_files.h"
#include "libindet/range/dealt_analysis.h"

namespace indet::app {
namespace {

/// Seconds; a packing of 95 disks takes 0.008 s to be collected where files are local (docs/cluster.md).
constexpr double kToCollectAPacking = 0.1;
/// A part of a packing of 1600 disks takes 0.01 s.
constexpr double kToJoinAPart = 0.1;

}  // namespace

SubmittedWork submitted_ensemble(const EnsembleArguments& arguments, bool overwrite, const Context& context) {
  const auto plan = std::make_shared<const Plan>(make_plan(config_of(arguments)));
  check_layout(arguments.folder);
  std::vector<std::filesystem::path> inputs(arguments.files.begin(), arguments.files.end());
  inputs.emplace_back(arguments.scene_file);
  claim_folder(arguments.folder, plan->members, replacement_rule(inputs, overwrite, context));
  SubmittedWork work;
  work.folder = arguments.folder;
  work.subcommand = "ensemble";
  work.items = std::ssize(plan->members);
  work.item = "packing";
  work.costs = dealt_costs(*plan);
  work.group = "seed or file";
  work.groups = "seeds and files";
  work.seconds_to_collect = kToCollectAPacking * static_cast<double>(work.items);
  work.afterwards = {"report", arguments.folder};
  work.write_plan = [plan, folder = arguments.folder] { write_plan(folder, *plan); };
  return work;
}

SubmittedWork submitted_analysis(const AnalyzeArguments& arguments, const std::string& folder, bool overwrite,
                                 const Context& context) {
  const auto planned = std::make_shared<const PlannedAnalysis>(plan_in_parts(arguments, context));
  const DealtAnalysis dealt(planned->packing, planned->options);  // which may refuse
  const AnalysisPlan& plan = planned->plan;
  claim_parts_folder(folder, plan, replacement_rule({arguments.packing}, overwrite, context), overwrite);
  SubmittedWork work;
  work.folder = folder;
  work.subcommand = "analyze";
  work.items = std::ssize(plan.chunks);
  work.item = "part";
  work.costs = dealt_costs(plan);
  work.group = "part";
  work.groups = "parts";
  work.seconds_to_collect = kToJoinAPart * static_cast<double>(work.items);
  work.write_plan = [planned, folder] { write_analysis_plan(folder, planned->plan); };
  return work;
}

}  // namespace indet::app
