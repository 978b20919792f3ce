#include "libindet/range/analyze.h"

#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/analysis_arguments.h"
#include "apps/command.h"
#include "apps/condition.h"
#include "apps/estimate_arguments.h"
#include "apps/exact_analysis.h"
#include "apps/memory_limit.h"
#include "apps/output_files.h"
#include "apps/packing_input.h"
#include "apps/ranges_report.h"
#include "apps/say.h"
#include "apps/wording.h"
#include "libindet/base/counted.h"
#include "libindet/io/packing_file.h"
#include "libindet/io/ranges_file.h"
#include "libindet/lp/glpk_problem.h"
#include "libindet/range/duals.h"

namespace indet::app {
namespace {

struct AnalyzeCommand {
  std::string packing;
  std::string output;
  bool overwrite = false;
  std::string method = "auto";
  std::optional<double> gap;
  std::vector<std::string> conditions;
  AnalysisArguments arguments;
};

/// Multipliers of all contacts can be more than a machine holds.
void require_memory_for_duals(const Packing& packing, const AnalyzeOptions& analysis) {
  using Kind = DualChoice::Kind;
  if (analysis.duals.kind == Kind::kNone) return;
  const std::vector<int> asked_for = chosen_contacts(analysis.contacts, packing.contact_count());
  const std::size_t contacts = contacts_with_duals(analysis.duals, asked_for).size();
  require_memory(dual_bytes(packing, contacts),
                 fmt::format("storing the multipliers of {}", counted(std::ssize(asked_for), "contact")));
}

int run(const AnalyzeCommand& options, const Context& context) {
  Packing packing = read_packing(open_packing(options.packing));
  apply_conditions(options.conditions, packing, options.packing);
  std::filesystem::path output = options.output;
  if (output.empty()) output = std::filesystem::path(options.packing).replace_extension(".ranges.h5");
  claim_output(output, FileKind::kRanges, replacement_rule({options.packing}, options.overwrite, context));
  AnalyzeOptions analysis = resolve(options.arguments, packing.contact_count(), context);
  if (options.method != "auto") analysis.method = value_of(options.method, kMethods);
  if (analysis.estimate) resolve_calibration(options.method, options.gap, analysis);
  if (options.gap && analysis.method.value_or(Method::kBarrier) != Method::kBarrier)
    throw UsageError("--gap has no effect without --method barrier, whose intervals it is about");
  if (options.gap) {
    analysis.gap = *options.gap;
    analysis.method = Method::kBarrier;  // intervals are wanted
  }
  if (analysis.duals.kind != DualChoice::Kind::kNone) {
    if (analysis.method.value_or(Method::kBarrier) != Method::kBarrier)
      throw UsageError(
          fmt::format("--duals {} has no effect without --method barrier, whose multipliers it is about",
                      options.arguments.duals));
    if (options.arguments.states == "canonical" || options.arguments.states_of != "all")
      throw UsageError(
          "--duals and extremal states do not go together: with a state kept, the value is proven by it");
    analysis.method = Method::kBarrier;
  }
  if (analysis.method == Method::kBarrier && options.arguments.states == "solver")
    throw UsageError(
        "--method barrier lands inside of optimal faces and not on extremal states; take --extremal-states "
        "canonical, or --method lp");
  if (analysis.method == Method::kBarrier && is_exact(options.arguments))
    throw UsageError(
        "--accuracy exact starts from the vertices of --method lp, and --method barrier has none");
  if (options.arguments.exact_budget && (analysis.method == Method::kBarrier || analysis.estimate))
    throw UsageError(
        "--exact-budget has no effect with --method barrier and --accuracy estimate: intervals are proven "
        "without exact arithmetic, and estimates are not");
  if (analysis.method != Method::kPivotingPaper) require_no_walk(options.arguments);
  if (analysis.method == Method::kPivotingTableau && analysis.formulation)
    throw UsageError(
        "--formulation has no effect with --method pivoting-tableau, which solves no linear programs");
  require_memory_for_duals(packing, analysis);
  const ForceRanges ranges =
      is_exact(options.arguments) ? analyze_exactly(packing, analysis, context) : analyze(packing, analysis);

  Provenance provenance;
  provenance.arguments = context.arguments;
  provenance.config = context.resolved_config;
  provenance.libraries["GLPK"] = glpk_version();
  write_ranges(output, packing, ranges, provenance);
  if (context.json) {
    std::cout << report_to_json(packing, ranges, output.string()).dump(2) << '\n';
  } else if (context.prints_report()) {
    print_report(packing, ranges, output.string());
    if (analysis.duals.kind != DualChoice::Kind::kNone && !ranges.duals.are_kept())
      say("no multipliers stored: there are none without an analytic centre, nor where rounding hides which "
          "edges are closed\n");
  }
  if (ranges.status == PolytopeStatus::kEmpty) return ranges.doubtful ? kUncertain : kNoAdmissibleState;
  return ranges.imprecise + ranges.failed + ranges.reactions.uncertain() > 0 ? kUncertain : kDone;
}

}  // namespace

Command add_analyze(CLI::App& root) {
  CLI::App* command = root.add_subcommand(
      "analyze", "Find the smallest and largest value of every contact force of a packing");
  const auto options = std::make_shared<AnalyzeCommand>();
  command->add_option("packing", options->packing, "HDF5 file of a packing, from simulate or import")
      ->required()
      ->type_name("P.h5");
  command->add_option("-o,--output", options->output, "File to write (default: P.ranges.h5 beside P.h5)")
      ->type_name("R.h5");
  add_overwrite_option(*command, options->overwrite);
  std::vector<std::string> method_names = names_of(kMethods);
  method_names.insert(method_names.begin(), "auto");
  command
      ->add_option(
          "--method", options->method,
          "How the extrema are found. lp: by linear programs; pivoting-paper: by the paper's walk from one "
          "extremal point to the next, as published; pivoting-tableau: by the same walk, made fast; barrier: "
          "a "
          "proven interval of each value, and extremal states where --extremal-states or --states-of ask for "
          "them, by an interior point method, which is the fastest for large packings; auto: lp, or barrier "
          "where it is faster")
      ->check(CLI::IsMember(method_names))
      ->capture_default_str();
  command
      ->add_option(
          "--gap", options->gap,
          "barrier: how wide the interval of a value may be, relative to the value, or to 1 mg where that is "
          "larger (default: 1e-6). With --method auto it asks for barrier")
      ->check(CLI::Range(1e-12, 0.5));
  add_condition_option(*command, options->conditions);
  add_analysis_options(*command, options->arguments, Levels::kAll);
  return {command, [options](const Context& context) { return run(*options, context); }};
}

}  // namespace indet::app
