#include "libindet/range/analyze.h"

#include <filesystem>
#include <memory>
#include <string>

#include "apps/analyze_arguments.h"
#include "apps/analyze_in_parts.h"
#include "apps/command.h"
#include "apps/exact_analysis.h"
#include "apps/output_files.h"
#include "apps/packing_input.h"
#include "apps/say.h"
#include "apps/scheduler.h"
#include "libindet/io/ranges_file.h"
#include "libindet/lp/glpk_problem.h"

namespace indet::app {
namespace {

struct AnalyzeCommand {
  AnalyzeArguments arguments;
  std::string output;
  std::string folder;  ///< of an analysis in parts
  ShareArguments share;
  bool overwrite = false;
};

void require_no_folder(const AnalyzeCommand& options) {
  if (!options.share.shard.empty())
    throw UsageError("--shard has no effect without --out, which names the folder that processes share");
  if (options.share.time_budget)
    throw UsageError("--time-budget has no effect without --out, where what is done is stored in parts");
}

int run(const AnalyzeCommand& options, const Context& context) {
  const AnalyzeArguments& arguments = options.arguments;
  if (!options.folder.empty()) {
    if (!options.output.empty())
      throw UsageError(
          "--out and --output do not go together: --out names a folder, in which the ranges of all contacts "
          "become ranges.h5; indet merge joins them into another file");
    return analyze_in_parts(arguments, options.folder, options.share, options.overwrite, context);
  }
  require_no_folder(options);
  const Packing packing = packing_of(open_packing(arguments.packing), arguments);
  std::filesystem::path output = options.output;
  if (output.empty()) output = std::filesystem::path(arguments.packing).replace_extension(".ranges.h5");
  claim_output(output, FileKind::kRanges, replacement_rule({arguments.packing}, options.overwrite, context));
  const AnalyzeOptions analysis = resolve(arguments, packing, context);
  const ForceRanges ranges =
      is_exact(arguments.analysis) ? analyze_exactly(packing, analysis, context) : analyze(packing, analysis);
  write_ranges(output, packing, ranges,
               {context.arguments, context.resolved_config, {{"GLPK", glpk_version()}}, {}});
  const int status = report_ranges(packing, ranges, output.string(), context);
  const bool wants_duals = analysis.duals.kind != DualChoice::Kind::kNone;
  if (context.prints_report() && wants_duals && !ranges.duals.are_kept())
    say("no multipliers stored: there are none without an analytic centre, nor where rounding hides which "
        "edges are closed\n");
  return status;
}

}  // namespace

Command add_analyze(CLI::App& root) {
  CLI::App* command = root.add_subcommand(
      "analyze", "Find the smallest and largest value of every contact force of a packing");
  const auto options = std::make_shared<AnalyzeCommand>();
  command->add_option("-o,--output", options->output, "File to write (default: P.ranges.h5 beside P.h5)")
      ->type_name("R.h5");
  command
      ->add_option(
          "--out", options->folder,
          "Folder in which processes share the work on a large packing, contact by contact, in place "
          "of a file; needs --method barrier, which auto takes for large packings")
      ->type_name("FOLDER");
  add_share_options(*command, "contacts", options->share);
  add_overwrite_option(*command, options->overwrite);
  add_analyze_options(*command, options->arguments);
  return {command, [options](const Context& context) { return run(*options, context); }};
}

}  // namespace indet::app
