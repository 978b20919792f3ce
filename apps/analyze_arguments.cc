#include "apps/analyze_arguments.h"

#include <fmt/format.h>

#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/condition.h"
#include "apps/estimate_arguments.h"
#include "apps/memory_limit.h"
#include "apps/ranges_report.h"
#include "apps/say.h"
#include "apps/wording.h"
#include "libindet/base/counted.h"
#include "libindet/io/packing_file.h"
#include "libindet/range/duals.h"

namespace indet::app {
namespace {

/// Multipliers of all contacts can be more than a machine holds.
void require_memory_for_duals(const Packing& packing, const AnalyzeOptions& analysis) {
  using Kind = DualChoice::Kind;
  if (analysis.duals.kind == Kind::kNone) return;
  const std::vector<int> asked_for = chosen_contacts(analysis.contacts, packing.contact_count());
  const std::size_t contacts = contacts_with_duals(analysis.duals, asked_for).size();
  require_memory(dual_bytes(packing, contacts),
                 fmt::format("storing the multipliers of {}", counted(std::ssize(asked_for), "contact")));
}

}  // namespace

void add_analyze_options(CLI::App& command, AnalyzeArguments& arguments) {
  command.add_option("packing", arguments.packing, "HDF5 file of a packing, from simulate or import")
      ->required()
      ->type_name("P.h5");
  std::vector<std::string> method_names = names_of(kMethods);
  method_names.insert(method_names.begin(), "auto");
  command
      .add_option(
          "--method", arguments.method,
          "How the extrema are found. lp: by linear programs; pivoting-paper: by the paper's walk from one "
          "extremal point to the next, as published; pivoting-tableau: by the same walk, made fast; barrier: "
          "a "
          "proven interval of each value, and extremal states where --extremal-states or --states-of ask for "
          "them, by an interior point method, which is the fastest for large packings; auto: lp, or barrier "
          "where it is faster")
      ->check(CLI::IsMember(method_names))
      ->capture_default_str();
  command
      .add_option(
          "--gap", arguments.gap,
          "barrier: how wide the interval of a value may be, relative to the value, or to 1 mg where that is "
          "larger (default: 1e-6). With --method auto it asks for barrier")
      ->check(CLI::Range(1e-12, 0.5));
  add_condition_option(command, arguments.conditions);
  add_analysis_options(command, arguments.analysis, Levels::kAll);
}

Packing packing_of(const Hdf5File& file, const AnalyzeArguments& arguments) {
  Packing packing = read_packing(file);
  apply_conditions(arguments.conditions, packing, arguments.packing);
  return packing;
}

AnalyzeOptions resolve(const AnalyzeArguments& options, const Packing& packing, const Context& context) {
  AnalyzeOptions analysis = resolve(options.analysis, packing.contact_count(), context);
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
                      options.analysis.duals));
    if (options.analysis.states == "canonical" || options.analysis.states_of != "all")
      throw UsageError(
          "--duals and extremal states do not go together: with a state kept, the value is proven by it");
    analysis.method = Method::kBarrier;
  }
  if (analysis.method == Method::kBarrier && options.analysis.states == "solver")
    throw UsageError(
        "--method barrier lands inside of optimal faces and not on extremal states; take --extremal-states "
        "canonical, or --method lp");
  if (analysis.method == Method::kBarrier && is_exact(options.analysis))
    throw UsageError(
        "--accuracy exact starts from the vertices of --method lp, and --method barrier has none");
  if (options.analysis.exact_budget && (analysis.method == Method::kBarrier || analysis.estimate))
    throw UsageError(
        "--exact-budget has no effect with --method barrier and --accuracy estimate: intervals are proven "
        "without exact arithmetic, and estimates are not");
  if (analysis.method != Method::kPivotingPaper) require_no_walk(options.analysis);
  if (analysis.method == Method::kPivotingTableau && analysis.formulation)
    throw UsageError(
        "--formulation has no effect with --method pivoting-tableau, which solves no linear programs");
  require_memory_for_duals(packing, analysis);
  return analysis;
}

int report_ranges(const Packing& packing, const ForceRanges& ranges, const std::string& output,
                  const Context& context) {
  if (context.json) {
    std::cout << report_to_json(packing, ranges, output).dump(2) << '\n';
  } else if (context.prints_report()) {
    print_report(packing, ranges, output);
  }
  if (ranges.status == PolytopeStatus::kEmpty) return ranges.doubtful ? kUncertain : kNoAdmissibleState;
  return ranges.imprecise + ranges.failed + ranges.reactions.uncertain() > 0 ? kUncertain : kDone;
}

}  // namespace indet::app
