#include "libindet/verify/verify.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/command.h"
#include "apps/exact_analysis.h"
#include "apps/packing_input.h"
#include "apps/say.h"
#include "libindet/io/bias_file.h"
#include "libindet/io/file_kind.h"
#include "libindet/io/limits_file.h"
#include "libindet/io/packing_file.h"
#include "libindet/io/ranges_file.h"
#include "libindet/io/sampling_file.h"
#include "libindet/io/vtkhdf.h"
#include "libindet/verify/bias_check.h"
#include "libindet/verify/comparisons.h"
#include "libindet/verify/exact_check.h"
#include "libindet/verify/limits_check.h"
#include "libindet/verify/outcome_check.h"
#include "libindet/verify/samples_check.h"
#include "libindet/verify/vtk_check.h"

namespace indet::app {
namespace {

/// A part of the file and what its check found.
struct Part {
  std::string title;
  Verification found;
};

Verification check_digests(const Hdf5File& file) {
  Comparisons compare;
  const Digests digests = compute_digests(file);
  compare.require(digests.numbers_match(), "content_sha256: some number is not the one that was written");
  compare.require(digests.texts_match(), "text_sha256: some text is not the one that was written");
  if (digests.stored_texts.empty())
    compare.leave_unchecked("texts (a version of indet wrote the file that stored no digest of them)");
  // Groups of which nothing is computed again.
  std::string accounts;
  for (const char* group : {"/simulation", "/tilt", "/trajectory", "/ensemble"}) {
    if (file.has(group)) accounts += fmt::format("{}{}", accounts.empty() ? "" : ", ", group);
  }
  if (!accounts.empty()) compare.leave_unchecked(accounts + " (simulations are not repeated)");
  return compare.result();
}

std::vector<Part> verify_file(const Hdf5File& file, bool exact, const Context& context) {
  std::vector<Part> parts = {{"file", check_digests(file)}};
  if (kind_of(file) == FileKind::kEnsemble) {
    parts.front().found.unchecked.emplace_back("tables of the ensemble (verify its members instead)");
    return parts;
  }
  const Packing packing = read_packing(file);
  std::optional<ForceRanges> ranges;
  std::optional<SamplingRecord> sampling;
  std::optional<SamplingRecord> uniform;
  if (has_ranges(file)) {
    ranges = read_ranges(file);
    parts.push_back({"force ranges", verify_ranges(packing, *ranges, context.progress())});
    if (has_vtkhdf(file)) parts.push_back({"/VTKHDF", verify_vtkhdf(file, packing, *ranges)});
  }
  if (has_limits(file)) parts.push_back({"/limits", verify_limits(packing, read_limits(file), exact)});
  const ForceRanges* known = ranges ? &*ranges : nullptr;
  const auto check_samples = [&](const std::string& group, std::optional<SamplingRecord>& record) {
    record = read_sampling(file, group);
    parts.push_back({group, verify_samples(packing, *record, group, known)});
  };
  if (file.has("/sampling")) check_samples("/sampling", sampling);
  if (file.has("/uniform/center")) check_samples("/uniform", uniform);
  if (file.has("/uniform")) {
    parts.push_back({"/uniform", verify_outcome(file.string_attribute("/uniform", "outcome"),
                                                uniform ? &*uniform : nullptr, known)});
  }
  if (const std::optional<BiasRecord> bias = read_bias(file)) {
    const SamplingRecord none;
    parts.push_back({"/bias", verify_bias(packing, *bias, sampling ? *sampling : none,
                                          uniform ? *uniform : none, known)});
  }
  return parts;
}

/// All parts together; what is left names its part.
Verification total_of(const std::vector<Part>& parts) {
  Verification total;
  for (const auto& [title, found] : parts) {
    total.checks += found.checks;
    total.contradictions += found.contradictions;
    total.states += found.states;
    total.optima += found.optima;
    total.worst_imbalance = std::fmax(total.worst_imbalance, found.worst_imbalance);
    total.worst_violation = std::fmax(total.worst_violation, found.worst_violation);
    total.worst_optimality_gap = std::fmax(total.worst_optimality_gap, found.worst_optimality_gap);
    total.messages.insert(total.messages.end(), found.messages.begin(), found.messages.end());
    for (const std::string& text : found.unchecked) total.unchecked.push_back(title + ": " + text);
    for (const std::string& text : found.remarks) total.remarks.push_back(title + ": " + text);
    for (const std::string& text : found.unsolved) total.unsolved.push_back(title + ": " + text);
  }
  return total;
}

void print(const std::string& path, const std::vector<Part>& parts, const Verification& total) {
  say("{}: {}, {}\n", path, counted(total.checks, "check"), counted(total.contradictions, "contradiction"));
  for (const std::string& message : total.messages) say("  {}\n", message);
  for (const auto& [title, found] : parts) {
    if (found.states == 0) continue;
    say("{}: {}, imbalance up to {:.1e} mg, contact conditions violated by up to {:.1e} mg\n", title,
        counted(found.states, title == "force ranges" ? "extremal state" : "state"), found.worst_imbalance,
        found.worst_violation);
    if (found.optima > 0)
      say("{}: {}, optimal but for gaps up to {:.1e}\n", title, counted(found.optima, "certified value"),
          found.worst_optimality_gap);
  }
  if (total.states == 0) say("there are no contact states in the file\n");
  const auto list = [](const char* heading, const std::vector<std::string>& texts) {
    if (!texts.empty()) say("{}:\n", heading);
    for (const std::string& text : texts) say("  {}\n", text);
  };
  list("not solved, or uncertain, as the file itself says", total.unsolved);
  for (const std::string& text : total.remarks) say("{}\n", text);
  list("not computed again, guarded by the digest alone", total.unchecked);
}

struct VerifyCommand {
  std::string file;
  bool exact = false;
};

nlohmann::json to_json(const ExactCheck& check, double seconds) {
  return {{"rank", check.rank},
          {"proven", check.proven},
          {"repaired", check.repaired},
          {"refuted", check.refuted},
          {"undecided", check.undecided},
          {"contradictions", check.contradictions},
          {"proves_emptiness", check.proves_emptiness},
          {"pivots", check.pivots},
          {"worst_error", check.worst_error},
          {"worst_certified_error", check.worst_certified_error},
          {"messages", check.messages},
          {"seconds", seconds}};
}

void print_exact(const ExactCheck& check, const ForceRanges& ranges, double seconds) {
  if (ranges.status == PolytopeStatus::kEmpty) {
    say("exact arithmetic: {} that no contact forces are admissible",
        check.proves_emptiness ? "proven" : "not proven");
  } else {
    say("exact arithmetic: {} proven, {} repaired, {} refuted, {} undecided; {} outside of their bounds",
        check.proven, check.repaired, check.refuted, check.undecided, check.contradictions);
  }
  say("; {} ({:.1f} s)\n", counted(check.pivots, "pivot"), seconds);
  for (const std::string& message : check.messages) say("  {}\n", message);
  if (check.proven + check.repaired > 0)
    say("worst |stored − exact|: {:.1e} mg, of the certified {:.1e} mg\n", check.worst_error,
        check.worst_certified_error);
}

int run(const VerifyCommand& options, const Context& context) {
  const std::string& path = options.file;
  const Hdf5File file = open_packing_or_ensemble(path);
  const std::vector<Part> parts = verify_file(file, options.exact, context);
  const Verification result = total_of(parts);
  std::optional<ExactCheck> check;
  std::optional<ForceRanges> ranges;
  double seconds = 0;
  if (options.exact && !(has_limits(file) && !has_ranges(file))) {
    const auto start = std::chrono::steady_clock::now();
    ranges = read_ranges(file);
    ExactCheckOptions exact;
    exact.threads = context.thread_count();
    exact.progress = context.progress();
    const Packing packing = read_packing(file);
    check = check_exactly(packing, with_states(packing, *ranges, context), exact);
    seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  const bool passed = result.passed() && (!check || check->passed());
  const bool is_certain = passed && result.unsolved.empty();
  if (context.json) {
    nlohmann::json json{{"file", path},
                        {"passed", passed},
                        {"checks", result.checks},
                        {"contradictions", result.contradictions},
                        {"messages", result.messages},
                        {"states", result.states},
                        {"worst_imbalance", result.worst_imbalance},
                        {"worst_violation", result.worst_violation},
                        {"optima", result.optima},
                        {"worst_optimality_gap", result.worst_optimality_gap},
                        {"not_solved", result.unsolved},
                        {"remarks", result.remarks},
                        {"not_checked", result.unchecked}};
    if (check) json["exact"] = to_json(*check, seconds);
    std::cout << json.dump(2) << '\n';
  } else if (!context.quiet || !is_certain) {
    print(path, parts, result);
    if (check) print_exact(*check, *ranges, seconds);
  }
  return is_certain ? kDone : kUncertain;
}

}  // namespace

Command add_verify(CLI::App& root) {
  CLI::App* command =
      root.add_subcommand("verify",
                          "Re-check the ranges, limits and samples of a file from its packing alone, "
                          "by other means than those that made them");
  const auto options = std::make_shared<VerifyCommand>();
  command->add_option("file", options->file, "The file to check")->required()->type_name("FILE.h5");
  command->add_flag("--exact", options->exact,
                    "Prove every range and limit in rational arithmetic, with the numbers of the packing "
                    "taken as they are");
  return {command, [options](const Context& context) { return run(*options, context); }};
}

}  // namespace indet::app
