#include "indet/verify/verify.h"

#include <fmt/format.h>

#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "command.h"
#include "indet/io/packing_file.h"
#include "indet/io/ranges_file.h"

namespace indet::app {
namespace {

/// What contradicts what in the file: its digests first, then its results.
Verification verify_file(const std::string& path, const Context& context) {
  Verification result;
  const Digests digests = compute_digests(path);
  const Packing packing = read_packing(path);
  if (file_has_ranges(path)) result = verify_ranges(packing, read_ranges(path), context.progress());
  ++result.checks;
  if (!digests.match()) {
    ++result.contradictions;
    result.messages.insert(result.messages.begin(),
                           "content_sha256: some number is not the one that was written");
  }
  return result;
}

int run(const std::string& path, const Context& context) {
  const Verification result = verify_file(path, context);
  if (context.json) {
    std::cout << nlohmann::json{{"file", path},
                                {"passed", result.passed()},
                                {"checks", result.checks},
                                {"contradictions", result.contradictions},
                                {"messages", result.messages},
                                {"worst_imbalance", result.worst_imbalance},
                                {"worst_violation", result.worst_violation},
                                {"worst_optimality_gap", result.worst_optimality_gap}}
                     .dump(2)
              << '\n';
  } else {
    fmt::print("{}: {} checks, {} contradictions\n", path, result.checks, result.contradictions);
    for (const std::string& message : result.messages) fmt::print("  {}\n", message);
    if (result.passed()) {
      fmt::print(
          "worst imbalance {:.1e} mg, worst contact violation {:.1e} mg, worst optimality gap {:.1e}\n",
          result.worst_imbalance, result.worst_violation, result.worst_optimality_gap);
    }
  }
  return result.passed() ? kDone : kUncertain;
}

}  // namespace

Command add_verify(CLI::App& root) {
  CLI::App* command = root.add_subcommand(
      "verify", "Re-check every stored result of a file from its packing alone, by other means than analyze");
  const auto file = std::make_shared<std::string>();
  command->add_option("file", *file, "The file to check")->required()->type_name("FILE.h5");
  return {command, [file](const Context& context) { return run(*file, context); }};
}

}  // namespace indet::app
