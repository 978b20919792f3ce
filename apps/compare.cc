#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/analysis_arguments.h"
#include "apps/command.h"
#include "apps/numbers.h"
#include "apps/packing_input.h"
#include "apps/paper_work.h"
#include "apps/say.h"
#include "apps/wording.h"
#include "libindet/base/tolerances.h"
#include "libindet/io/packing_file.h"
#include "libindet/range/analyze.h"

namespace indet::app {
namespace {

struct CompareCommand {
  std::string packing;
  double tolerance = 1e-8;
  AnalysisArguments arguments;
};

/// Two methods give different values that both call certified.
struct Disagreement {
  int contact = 0;
  Column column = kMinR;
  double expected = 0, found = 0;  ///< mg
};

/// How one method's results stand to those of the first.
struct MethodComparison {
  double worst_difference = 0;  ///< mg, of values that both call certified
  double worst_imprecise = 0;   ///< mg, of values that some method calls imprecise
  std::int64_t compared = 0;    ///< values that both call certified
  std::int64_t states = 0, same_states = 0;
  std::vector<Disagreement> disagreements;
};

void compare_states(const ForceRanges& expected, const ForceRanges& found, Eigen::Index i, int column,
                    MethodComparison& comparison) {
  const int first = expected.vertex(i, column);
  const int second = found.vertex(i, column);
  if (first < 0 || second < 0) return;
  ++comparison.states;
  const double distance = (expected.states.row(first) - found.states.row(second)).norm();
  const double scale = std::max(expected.force_unit, expected.states.row(first).norm());
  if (distance <= tolerance::kSameState * scale) ++comparison.same_states;
}

MethodComparison compare(const ForceRanges& expected, const ForceRanges& found, double tolerance) {
  MethodComparison comparison;
  for (Eigen::Index i = 0; i < expected.value.rows(); ++i) {
    for (int column = 0; column < 4; ++column) {
      const double a = expected.value(i, column) / expected.force_unit;
      const double b = found.value(i, column) / expected.force_unit;
      if (std::isnan(a) || std::isnan(b)) continue;
      const double difference = a == b ? 0 : std::abs(a - b);
      if (is_certified(expected.outcome(i, column)) && is_certified(found.outcome(i, column))) {
        ++comparison.compared;
        comparison.worst_difference = std::max(comparison.worst_difference, difference);
        if (difference > tolerance)
          comparison.disagreements.push_back({static_cast<int>(i), static_cast<Column>(column), a, b});
        compare_states(expected, found, i, column, comparison);
      } else {
        comparison.worst_imprecise = std::max(comparison.worst_imprecise, difference);
      }
    }
  }
  return comparison;
}

double stage_seconds(const ForceRanges& ranges, const std::string& stage) {
  const auto found = ranges.seconds.find(stage);
  return found == ranges.seconds.end() ? 0 : found->second;
}

struct Entry {
  ForceRanges ranges;
  MethodComparison comparison;  ///< with the first entry
};

nlohmann::json to_json(const Entry& entry) {
  const ForceRanges& r = entry.ranges;
  const MethodComparison& c = entry.comparison;
  nlohmann::json json = {
      {"method", to_string(r.method)},
      {"formulation", r.formulation},
      {"objectives", r.objectives},
      {"certified", r.certified},
      {"unbounded", r.unbounded},
      {"imprecise", r.imprecise},
      {"failed", r.failed},
      {"solves", r.solves},
      {"pivots", r.pivots},
      {"states", r.states.rows()},
      {"seconds", r.seconds},
      {"compared", c.compared},
      {"worst_difference", c.worst_difference},
      {"worst_imprecise_difference",
       std::isfinite(c.worst_imprecise) ? nlohmann::json(c.worst_imprecise) : nlohmann::json("inf")},
      {"compared_states", c.states},
      {"same_states", c.same_states},
      {"disagreements", nlohmann::json::array()}};
  for (const Disagreement& d : c.disagreements) {
    json["disagreements"].push_back({{"contact", d.contact},
                                     {"objective", to_string(d.column)},
                                     {"expected", fmt::format("{}", d.expected)},
                                     {"found", fmt::format("{}", d.found)}});
  }
  if (r.method == Method::kPivotingPaper) json["paper"] = describe_paper_work(r);
  return json;
}

/// One line of the table; `cell` gives the text of an entry.
template <class Cell>
void print_row(const char* name, const std::vector<Entry>& entries, Cell cell) {
  say("{:<34}", name);
  for (const Entry& entry : entries) say("{:>18}", cell(entry));
  say("\n");
}

void print_table(const std::vector<Entry>& entries) {
  const auto seconds = [](const char* stage) {
    return [stage](const Entry& e) { return fmt::format("{:.3f}", stage_seconds(e.ranges, stage)); };
  };
  const auto count = [](std::int64_t ForceRanges::*field) {
    return [field](const Entry& e) { return fmt::format("{}", e.ranges.*field); };
  };
  print_row("", entries, [](const Entry& e) { return to_string(e.ranges.method); });
  print_row("formulation", entries,
            [](const Entry& e) { return e.ranges.formulation.empty() ? "-" : e.ranges.formulation; });
  print_row("neighbour, start of the walks", entries, [](const Entry& e) -> std::string {
    if (e.ranges.method != Method::kPivotingPaper) return "-";
    const PaperOptions& options = e.ranges.paper_options;
    return fmt::format("{}, {}", to_string(options.neighbour), to_string(options.start));
  });
  print_row("certified", entries, count(&ForceRanges::certified));
  print_row("imprecise", entries, count(&ForceRanges::imprecise));
  print_row("failed", entries, count(&ForceRanges::failed));
  print_row("largest difference from lp (mg)", entries,
            [](const Entry& e) { return fmt::format("{:.1e}", e.comparison.worst_difference); });
  print_row("same extremal state as lp", entries, [](const Entry& e) -> std::string {
    if (e.ranges.state_kind == StateChoice::Kind::kNone) return "none kept";
    return fmt::format("{} of {}", e.comparison.same_states, e.comparison.states);
  });
  print_row("searches (linear programs, walks)", entries, count(&ForceRanges::solves));
  print_row("pivots", entries, count(&ForceRanges::pivots));
  print_row("seconds for the ranges", entries, seconds("ranges"));
  print_row("seconds for canonical states", entries, seconds("states"));
  print_row("time for the ranges / that of lp", entries, [&](const Entry& e) {
    return fmt::format("{:.2f}",
                       stage_seconds(e.ranges, "ranges") / stage_seconds(entries.front().ranges, "ranges"));
  });
}

void print_disagreements(const std::vector<Entry>& entries, double tolerance) {
  constexpr std::size_t kShown = 10;
  for (const Entry& entry : entries) {
    const std::vector<Disagreement>& all = entry.comparison.disagreements;
    if (all.empty()) continue;
    say("\n{} and lp certify values that differ by more than {:g} mg:\n", to_string(entry.ranges.method),
        tolerance);
    for (std::size_t i = 0; i < std::min(kShown, all.size()); ++i) {
      say("  contact {:<6} {}  {:.12g} instead of {:.12g}\n", all[i].contact, to_string(all[i].column),
          all[i].found, all[i].expected);
    }
    if (all.size() > kShown) say("  … and {} more\n", all.size() - kShown);
  }
}

int status_of(const std::vector<Entry>& entries) {
  const ForceRanges& lp = entries.front().ranges;
  if (lp.status == PolytopeStatus::kEmpty) return lp.doubtful ? kUncertain : kNoAdmissibleState;
  for (const Entry& entry : entries) {
    const bool is_uncertain = entry.ranges.imprecise + entry.ranges.failed > 0;
    if (is_uncertain || !entry.comparison.disagreements.empty()) return kUncertain;
  }
  return kDone;
}

/// The first linear algebra of a process starts OpenBLAS's threads and touches memory for the first time,
/// which must not be charged to the method that happens to come first.
void start_libraries(const Packing& packing) {
  AnalyzeOptions one_contact;
  one_contact.contacts.kind = ContactChoice::Kind::kSample;
  one_contact.contacts.sample_size = 1;
  analyze(packing, one_contact);
}

/// The time of what every method does before its search.
double common_seconds(const std::vector<Entry>& entries) {
  double least = std::numeric_limits<double>::infinity();
  for (const Entry& entry : entries) least = std::min(least, stage_seconds(entry.ranges, "polytope"));
  return least;
}

/// The same contacts for every method: each would draw a sample in its own way.
void fix_sample(ContactChoice& choice, int contacts) {
  if (choice.kind != ContactChoice::Kind::kSample) return;
  choice.list = chosen_contacts(choice, contacts);
  choice.kind = ContactChoice::Kind::kList;
}

int run(const CompareCommand& options, const Context& context) {
  const Packing packing = read_packing(open_packing(options.packing));
  start_libraries(packing);
  std::vector<Entry> entries;
  for (const Method method : kVertexMethods) {
    AnalyzeOptions analysis = resolve(options.arguments, packing.contact_count(), context);
    analysis.method = method;
    analysis.reactions = false;  // contact forces are compared,
    analysis.exact_work = 0;     // as the method finds them
    fix_sample(analysis.contacts, packing.contact_count());
    if (analysis.progress) {
      analysis.progress = [&, report = analysis.progress](const Progress& progress) {
        return report({to_string(method), progress.done, progress.total, progress.details});
      };
    }
    Entry entry;
    entry.ranges = analyze(packing, analysis);
    entry.comparison =
        compare(entries.empty() ? entry.ranges : entries.front().ranges, entry.ranges, options.tolerance);
    entries.push_back(std::move(entry));
  }
  const ForceRanges& lp = entries.front().ranges;
  if (context.json) {
    nlohmann::json json = {{"packing", options.packing},
                           {"disks", packing.disk_count()},
                           {"contacts", packing.contact_count()},
                           {"status", to_string(lp.status)},
                           {"dim", lp.dim},
                           {"requested", lp.requested},
                           {"tolerance", options.tolerance},
                           {"common_seconds", common_seconds(entries)},
                           {"methods", nlohmann::json::array()}};
    for (const Entry& entry : entries) json["methods"].push_back(to_json(entry));
    std::cout << json.dump(2) << '\n';
    return status_of(entries);
  }
  if (context.quiet) return status_of(entries);
  say("{}, {}: polytope of contact states {}, dimension {}\n", describe_disks(packing),
      counted(packing.contact_count(), "contact"), to_string(lp.status), lp.dim);
  say("common to all methods: {:.3f} s (polytope)\n\n", common_seconds(entries));
  print_table(entries);
  say("\n");
  for (const Entry& entry : entries) {
    if (entry.ranges.method == Method::kPivotingPaper) print_paper_work(entry.ranges.paper);
  }
  print_disagreements(entries, options.tolerance);
  return status_of(entries);
}

}  // namespace

Command add_compare(CLI::App& root) {
  CLI::App* command = root.add_subcommand("compare",
                                          "Find the ranges of a packing by each --method of analyze, and "
                                          "compare values, extremal states, pivots and times");
  const auto options = std::make_shared<CompareCommand>();
  command->add_option("packing", options->packing, "HDF5 file of a packing, from simulate or import")
      ->required()
      ->type_name("P.h5");
  command
      ->add_option("--tolerance", options->tolerance,
                   "Largest difference (mg) at which two values agree; if any two differ by more, the exit "
                   "status is 5")
      ->check(not_negative())
      ->capture_default_str();
  add_analysis_options(*command, options->arguments, Levels::kFloatingPoint);
  return {command, [options](const Context& context) { return run(*options, context); }};
}

}  // namespace indet::app
