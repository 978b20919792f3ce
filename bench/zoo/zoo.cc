// How far `analyze` can be trusted at the extremes: every result of several hundred fixed and many random
// scenes, beside the exact answer. Prints a table by kind of scene; exit status 1 if a single number is
// silently wrong. A second table has the same for the other formulations and methods, over the fixed scenes
// and a tenth of the random ones.
//
// Last come the scenes with a mark.
//
//   bench_zoo [RANDOM] [MOST]    RANDOM random scenes (default 10000) of up to MOST disks (default 3), and a
//                                fifth as many others of up to one disk more

#include <fmt/format.h>

#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "libindet/packing/validate.h"
#include "libindet/range/analyze.h"
#include "tests/support/extremes.h"

namespace {

struct Variant {
  std::string name;
  indet::AnalyzeOptions options;
};

std::vector<Variant> variants() {
  using namespace indet;
  std::vector<Variant> result;
  for (const Formulation formulation : {Formulation::kNullSpace, Formulation::kDual, Formulation::kEdge}) {
    AnalyzeOptions options;
    options.formulation = formulation;
    result.push_back({std::string("linear programs, ") + to_string(formulation), options});
  }
  for (const Method method : {Method::kPivotingTableau, Method::kPivotingPaper}) {
    AnalyzeOptions options;
    options.method = method;
    result.push_back({to_string(method), options});
  }
  result.push_back({"--accuracy fast", options_for(Accuracy::kFast)});
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace indet;
  const int count = argc > 1 ? std::atoi(argv[1]) : 10000;
  const int most = argc > 2 ? std::atoi(argv[2]) : 3;
  std::vector<std::string> order;
  std::map<std::string, std::pair<int, extremes::Tally>> table;
  extremes::Tally total;
  int scenes = 0;
  std::vector<std::string> marked;
  std::vector<std::pair<Variant, extremes::Tally>> by_variant;
  for (const Variant& variant : variants()) by_variant.emplace_back(variant, extremes::Tally());
  const auto visit = [&](const extremes::Scene& scene, bool in_all_variants) {
    if (find_defect(scene.packing)) {
      fmt::print("{}, {}: refused by the validation: {}\n", scene.kind, scene.name,
                 find_defect(scene.packing)->reason);
      return;
    }
    const extremes::Judge judge(scene);
    const auto judged = [&](const AnalyzeOptions& options) {
      extremes::Tally tally;
      try {
        tally = judge.judge(analyze(scene.packing, options));
      } catch (const std::exception& error) {
        fmt::print("{}, {}: {}\n", scene.kind, scene.name, error.what());
        ++tally.marked;
      }
      return tally;
    };
    const extremes::Tally tally = judged({});
    if (tally.marked > 0) marked.push_back(fmt::format("{}, {}: {}", scene.kind, scene.name, tally.marked));
    if (in_all_variants) {
      for (auto& [variant, sum] : by_variant) sum.add(judged(variant.options));
    }
    if (table.count(scene.kind) == 0) order.push_back(scene.kind);
    auto& [number, sum] = table[scene.kind];
    ++number;
    ++scenes;
    sum.add(tally);
    total.add(tally);
  };
  for (const extremes::Scene& scene : extremes::fixed_scenes()) visit(scene, true);
  for (int seed = 0; seed < count; ++seed)
    visit(extremes::random_scene(static_cast<std::uint64_t>(seed), most), seed % 10 == 0);
  // Others, and larger ones: nothing was looked at in them while the program was written.
  constexpr int kOtherSeeds = 1'000'000;
  for (int seed = kOtherSeeds; seed < kOtherSeeds + count / 5; ++seed)
    visit(extremes::random_scene(static_cast<std::uint64_t>(seed), most + 1), false);

  const auto line = [](const std::string& name, int number, const extremes::Tally& tally) {
    const auto sum = static_cast<double>(tally.right + tally.contained + tally.marked + tally.wrong);
    fmt::print("| {:<38} | {:>6} | {:>7} | {:>9} | {:>6} | {:>5} | {:>6.1f} % |\n", name, number, tally.right,
               tally.contained, tally.marked, tally.wrong,
               100 * static_cast<double>(tally.right + tally.contained) / sum);
  };
  fmt::print("| {:<38} | {:>6} | {:>7} | {:>9} | {:>6} | {:>5} | {:>8} |\n", "kind of scene", "scenes",
             "right", "contained", "marked", "wrong", "unmarked");
  fmt::print("|---|---|---|---|---|---|---|\n");
  for (const std::string& kind : order) line(kind, table[kind].first, table[kind].second);
  line("all", scenes, total);
  fmt::print("\n| {:<38} | {:>7} | {:>9} | {:>6} | {:>5} |\n|---|---|---|---|---|\n", "by another way",
             "right", "contained", "marked", "wrong");
  for (const auto& [variant, tally] : by_variant) {
    fmt::print("| {:<38} | {:>7} | {:>9} | {:>6} | {:>5} |\n", variant.name, tally.right, tally.contained,
               tally.marked, tally.wrong);
    total.add(tally);
  }
  if (!marked.empty()) fmt::print("\nmarked, and how many values:\n");
  for (const std::string& scene : marked) fmt::print("- {}\n", scene);
  for (const std::string& complaint : total.complaints) fmt::print("WRONG {}\n", complaint);
  return total.wrong == 0 ? 0 : 1;
}
