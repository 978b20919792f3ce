#include "apps/analysis_arguments.h"

#include <fmt/format.h>

#include <charconv>
#include <optional>
#include <sstream>
#include <vector>

#include "apps/estimate_arguments.h"
#include "apps/numbers.h"
#include "libindet/base/printable.h"

namespace indet::app {
namespace {

/// All of the text as a number ≥ 0.
std::optional<int> parse_count(const std::string& text) {
  int number = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || stop != end || number < 0) return {};
  return number;
}

[[noreturn]] void refuse_contacts(const std::string& text) {
  throw UsageError(fmt::format(
      "--contacts {}: expected all, sample:K (K contacts drawn at random), or a list like 3,7,12-20",
      excerpt(text)));
}

}  // namespace

std::vector<int> parse_contact_list(const std::string& option, const std::string& whole,
                                    const std::string& text, int contacts) {
  const auto refuse = [&] {
    throw UsageError(
        fmt::format("{} {}: expected a list of contacts like 3,7,12-20", option, excerpt(whole)));
  };
  std::vector<int> list;
  std::istringstream items(text);
  for (std::string item; std::getline(items, item, ',');) {
    const std::size_t dash = item.find('-');
    const std::optional<int> first = parse_count(item.substr(0, dash));
    const std::optional<int> last = dash == std::string::npos ? first : parse_count(item.substr(dash + 1));
    if (!first || !last || *last < *first) refuse();
    if (*last >= contacts) {
      throw UsageError(fmt::format("{} {}: there is no contact {}; the packing has {}, numbered from 0",
                                   option, excerpt(whole), *last, counted(contacts, "contact")));
    }
    for (int contact = *first; contact <= *last; ++contact) list.push_back(contact);
  }
  if (list.empty() || text.back() == ',') refuse();
  return list;
}

namespace {

ContactChoice parse_contacts(const AnalysisArguments& arguments, int contacts) {
  const std::string& text = arguments.contacts;
  ContactChoice choice;
  const std::string prefix = "sample:";
  if (text.starts_with(prefix)) {
    const std::optional<int> size = parse_count(text.substr(prefix.size()));
    if (!size || *size == 0) refuse_contacts(text);
    choice.kind = ContactChoice::Kind::kSample;
    choice.sample_size = *size;
    choice.seed = arguments.seed;
    return choice;
  }
  if (arguments.seed != AnalysisArguments().seed && arguments.neighbour != "random" &&
      !arguments.duals.starts_with(prefix))
    throw UsageError(
        "--seed has no effect without --contacts sample:K, --duals sample:K or --neighbour random, which "
        "draw by chance");
  if (text == "all") return choice;
  choice.kind = ContactChoice::Kind::kList;
  if (text.find_first_not_of("0123456789,-") != std::string::npos) refuse_contacts(text);
  choice.list = parse_contact_list("--contacts", text, text, contacts);
  return choice;
}

StateChoice parse_states(const AnalysisArguments& arguments, int contacts) {
  StateChoice choice =
      options_for(arguments.accuracy == "fast" ? Accuracy::kFast : Accuracy::kStandard).states;
  choice.within_limit = arguments.states == "auto";
  for (const StateChoice::Kind kind : kStateKinds) {
    if (arguments.states == to_string(kind)) choice.kind = kind;
  }
  const std::string& text = arguments.states_of;
  if (text == "all") return choice;
  if (choice.kind == StateChoice::Kind::kNone)
    throw UsageError(
        fmt::format("--states-of {} has no effect with --extremal-states none, which keeps no states", text));
  const std::string prefix = "largest:";
  if (text.starts_with(prefix)) {
    const std::optional<int> count = parse_count(text.substr(prefix.size()));
    if (!count || *count == 0)
      throw UsageError(fmt::format("--states-of {}: expected a number of contacts from 1 on", text));
    choice.contacts = StateChoice::Contacts::kLargest;
    choice.largest = *count;
    return choice;
  }
  if (text.find_first_not_of("0123456789,-") != std::string::npos)
    throw UsageError(
        fmt::format("--states-of {}: expected all, largest:K (the K contacts of largest δR + δT), or a list "
                    "like 3,7,12-20",
                    text));
  choice.contacts = StateChoice::Contacts::kList;
  choice.list = parse_contact_list("--states-of", text, text, contacts);
  return choice;
}

DualChoice parse_duals(const AnalysisArguments& arguments) {
  DualChoice choice;
  choice.seed = arguments.seed;
  const std::string& text = arguments.duals;
  const std::string prefix = "sample:";
  if (text == "none") return choice;
  choice.kind = text == "all" ? DualChoice::Kind::kAll : DualChoice::Kind::kSample;
  if (text == "all") return choice;
  const std::optional<int> size =
      text.starts_with(prefix) ? parse_count(text.substr(prefix.size())) : std::nullopt;
  if (!size || *size == 0)
    throw UsageError(
        fmt::format("--duals {}: expected none, all, or sample:K (K contacts drawn at random)", text));
  choice.sample_size = *size;
  return choice;
}

std::optional<Formulation> parse_formulation(const std::string& name) {
  for (const Formulation formulation : {Formulation::kNullSpace, Formulation::kDual, Formulation::kEdge}) {
    if (name == to_string(formulation)) return formulation;
  }
  return {};
}

}  // namespace

void add_analysis_options(CLI::App& command, AnalysisArguments& arguments, Levels levels) {
  std::string help =
      "standard: double precision, each value between proven bounds; fast: the same values in about half of "
      "the time, but the extremal states (and dR, dT, which depend on them) are those the solver happens to "
      "find";
  std::vector<std::string> names = {"fast", "standard"};
  if (levels == Levels::kAll) {
    help +=
        "; exact: each value computed without rounding and rounded once (some seconds for a hundred disks, "
        "two minutes for 400); estimate: δR and δT of all contacts predicted instead of found, each with a "
        "95 % interval, "
        "in "
        "seconds for 10000 disks (see --calibrate)";
    names.insert(names.end(), {"exact", "estimate"});
  }
  command.add_option("--accuracy", arguments.accuracy, help)
      ->check(CLI::IsMember(names))
      ->capture_default_str();
  command
      .add_option(
          "--contacts", arguments.contacts,
          "Which contacts to find the ranges of: all; sample:K, that is K contacts drawn at random (with "
          "--method barrier those more often whose ranges promise to be large), which gives a confidence "
          "interval for the mean over all; or a list like 3,7,12-20 (numbered from 0)")
      ->type_name("all|sample:K|LIST")
      ->capture_default_str();
  command
      .add_option("--seed", arguments.seed,
                  std::string("Seed of the random numbers of --contacts sample:K and of --neighbour random") +
                      (levels == Levels::kAll ? ", of --duals sample:K, and of --accuracy estimate" : ""))
      ->check(not_negative())
      ->capture_default_str();
  if (levels == Levels::kAll) {
    command
        .add_option(
            "--calibrate", arguments.calibrate,
            "estimate: on how many contacts, drawn at random with --seed, the predictions are calibrated; "
            "their ranges are found by the barrier method (default: 20). From 19 on the intervals hold "
            "for packings of any kind; with 0 no range is found, and they hold for packings like those "
            "that the program's own coefficients come from")
        ->check(not_negative());
    command
        .add_option(
            "--reactions", arguments.reactions,
            "Whether to find the ranges of the reactions of walls and fixed disks, too: all; none; auto: "
            "all, but none where some contacts only are asked for, or estimates")
        ->check(CLI::IsMember({"auto", "all", "none"}))
        ->capture_default_str();
    command
        .add_option(
            "--duals", arguments.duals,
            "barrier: of which contacts to store the multipliers and a state that prove each value, so "
            "that verify can check it without trust in this program: none; all; or sample:K, that is "
            "K of those whose ranges are found, drawn at random with --seed (2.4 MB a contact of "
            "10000 disks)")
        ->type_name("none|sample:K|all")
        ->capture_default_str();
    command
        .add_option("--exact-budget", arguments.exact_budget,
                    "How much rational arithmetic may find all results again where double precision leaves "
                    "some in doubt, with --accuracy fast and standard, in solves of 100 equations (one of n "
                    "equations counts as 0.1 + n^2 / 10000; default: 200). Single values are settled before, "
                    "by up to 100 further ones. 0: nothing is settled so")
        ->check(CLI::NonNegativeNumber);
    command.add_flag(
        "--smallest-distances", arguments.smallest_distances,
        "Also find dR_min and dT_min of these contacts: the smallest distance between a state of "
        "largest and one of smallest R (or T), whichever of several extremal states are stored. "
        "It takes longer than the ranges themselves");
  }
  command
      .add_option(
          "--formulation", arguments.formulation,
          "How the linear programs are written down (docs/theory.md, section 7); the results are the same")
      ->check(CLI::IsMember({"auto", "nullspace", "dual", "edge"}))
      ->capture_default_str();
  command
      .add_option("--extremal-states", arguments.states,
                  "Which extremal states to store. canonical: where many attain the same extremum, the one "
                  "of smallest "
                  "total normal force; solver: the one the solver happens to find; none: none, only what is "
                  "found out "
                  "about the values (then dR and dT are not known); auto: canonical, but solver with "
                  "--accuracy fast, "
                  "and none where those of all contacts could take more than 100 MB (from 1251 contacts on)")
      ->check(CLI::IsMember({"auto", "none", "canonical", "solver"}))
      ->capture_default_str();
  command
      .add_option("--states-of", arguments.states_of,
                  "Of which contacts to store the extremal states: all; largest:K, that is the K contacts of "
                  "largest δR + δT; or a list like 3,7,12-20 (numbered from 0)")
      ->type_name("all|largest:K|LIST")
      ->capture_default_str();
  command
      .add_option("--neighbour", arguments.neighbour,
                  "pivoting-paper: where a walk goes on. first (the default): to the first neighbour found "
                  "that is better, as the paper says; best: to the best of all; random: to the first, in an "
                  "order drawn with --seed")
      ->check(CLI::IsMember(names_of(kNeighbourRules)));
  command
      .add_option("--start", arguments.start,
                  "pivoting-paper: where a walk starts. common (the default): each from the one first "
                  "extremal point; minimum: the maximum of a force from its minimum")
      ->check(CLI::IsMember(names_of(kWalkStarts)));
}

bool is_estimate(const AnalysisArguments& arguments) { return arguments.accuracy == "estimate"; }

bool is_exact(const AnalysisArguments& arguments) { return arguments.accuracy == "exact"; }

void require_no_walk(const AnalysisArguments& arguments) {
  const auto require_none = [](const char* name, const std::optional<std::string>& value) {
    if (!value) return;
    throw UsageError(fmt::format(
        "{} {} has no effect without --method pivoting-paper, whose walks it is about", name, *value));
  };
  require_none("--neighbour", arguments.neighbour);
  require_none("--start", arguments.start);
}

AnalyzeOptions resolve(const AnalysisArguments& arguments, int contacts, const Context& context) {
  AnalyzeOptions options;
  if (is_estimate(arguments)) {
    options.estimate = parse_estimate(arguments);
  } else {
    if (arguments.calibrate)
      throw UsageError(
          "--calibrate has no effect without --accuracy estimate, whose predictions it is about");
    options.contacts = parse_contacts(arguments, contacts);
  }
  options.duals = parse_duals(arguments);
  using Exactness = AnalyzeOptions::Exactness;
  constexpr double kSquareOfHundred = 1e4;
  if (is_exact(arguments)) {
    if (arguments.exact_budget)
      throw UsageError("--exact-budget has no effect with --accuracy exact, which takes what it needs");
  } else if (arguments.exact_budget) {
    options.exact_work = *arguments.exact_budget * kSquareOfHundred;
    if (*arguments.exact_budget == 0) options.exactness = Exactness::kNowhere;
  }
  if (arguments.smallest_distances && options.estimate)
    throw UsageError(
        "--smallest-distances has no effect with --accuracy estimate, which looks for no extremal states");
  options.smallest_distances = arguments.smallest_distances;
  const bool wants_all = options.contacts.kind == ContactChoice::Kind::kAll && !options.estimate;
  options.reactions = arguments.reactions == "all" || (arguments.reactions == "auto" && wants_all);
  options.formulation = parse_formulation(arguments.formulation);
  options.states = parse_states(arguments, contacts);
  if (const auto reason = options.states.defect(chosen_contacts(options.contacts, contacts)))
    throw UsageError(fmt::format("--states-of {}: {}", arguments.states_of, *reason));
  if (arguments.neighbour) options.paper.neighbour = value_of(*arguments.neighbour, kNeighbourRules);
  if (arguments.start) options.paper.start = value_of(*arguments.start, kWalkStarts);
  options.paper.seed = static_cast<std::int64_t>(arguments.seed);
  options.threads = context.thread_count();
  options.progress = context.progress();
  return options;
}

}  // namespace indet::app
