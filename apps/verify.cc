#include "libindet/verify/verify.h"

#include <fmt/format.h>

#include <chrono>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "apps/command.h"
#include "apps/packing_input.h"
#include "libindet/io/packing_file.h"
#include "libindet/io/ranges_file.h"
#include "libindet/verify/exact_check.h"

namespace indet::app {
namespace {

/// What contradicts what in the file: its digests first, then its results.
Verification verify_file(const Hdf5File& file, const Context& context) {
  Verification result;
  const Digests digests = compute_digests(file);
  const Packing packing = read_packing(file);
  if (has_ranges(file)) result = verify_ranges(packing, read_ranges(file), context.progress());
  ++result.checks;
  if (!digests.match()) {
    ++result.contradictions;
    result.messages.insert(result.messages.begin(),
                           "content_sha256: some number is not the one that was written");
  }
  return result;
}

struct Options {
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
    fmt::print("exact arithmetic: {} that the packing cannot stand",
               check.proves_emptiness ? "proven" : "not proven");
  } else {
    fmt::print(
        "exact arithmetic: {} proven, {} repaired, {} refuted, {} undecided; {} outside of their bounds",
        check.proven, check.repaired, check.refuted, check.undecided, check.contradictions);
  }
  fmt::print("; {} pivots ({:.1f} s)\n", check.pivots, seconds);
  for (const std::string& message : check.messages) fmt::print("  {}\n", message);
  if (ranges.status != PolytopeStatus::kEmpty)
    fmt::print("worst |stored − exact|: {:.1e} mg, of the certified {:.1e} mg\n", check.worst_error,
               check.worst_certified_error);
}

int run(const Options& options, const Context& context) {
  const std::string& path = options.file;
  const Hdf5File file = open_packing(path);
  const Verification result = verify_file(file, context);
  std::optional<ExactCheck> check;
  std::optional<ForceRanges> ranges;
  double seconds = 0;
  if (options.exact) {
    const auto start = std::chrono::steady_clock::now();
    ranges = read_ranges(file);
    ExactCheckOptions exact;
    exact.threads = context.thread_count();
    exact.progress = context.progress();
    check = check_exactly(read_packing(file), *ranges, exact);
    seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  if (context.json) {
    nlohmann::json json{{"file", path},
                        {"passed", result.passed() && (!check || check->passed())},
                        {"checks", result.checks},
                        {"contradictions", result.contradictions},
                        {"messages", result.messages},
                        {"worst_imbalance", result.worst_imbalance},
                        {"worst_violation", result.worst_violation},
                        {"worst_optimality_gap", result.worst_optimality_gap}};
    if (check) json["exact"] = to_json(*check, seconds);
    std::cout << json.dump(2) << '\n';
  } else if (!context.quiet || !result.passed() || (check && !check->passed())) {
    fmt::print("{}: {} checks, {} contradictions\n", path, result.checks, result.contradictions);
    for (const std::string& message : result.messages) fmt::print("  {}\n", message);
    if (result.passed()) {
      fmt::print(
          "worst imbalance {:.1e} mg, worst contact violation {:.1e} mg, worst optimality gap {:.1e}\n",
          result.worst_imbalance, result.worst_violation, result.worst_optimality_gap);
    }
    if (check) print_exact(*check, *ranges, seconds);
  }
  return result.passed() && (!check || check->passed()) ? kDone : kUncertain;
}

}  // namespace

Command add_verify(CLI::App& root) {
  CLI::App* command = root.add_subcommand(
      "verify", "Re-check every stored result of a file from its packing alone, by other means than analyze");
  const auto options = std::make_shared<Options>();
  command->add_option("file", options->file, "The file to check")->required()->type_name("FILE.h5");
  command->add_flag(
      "--exact", options->exact,
      "Prove every range in rational arithmetic, with the numbers of the packing taken as they are");
  return {command, [options](const Context& context) { return run(*options, context); }};
}

}  // namespace indet::app
