// How far `analyze` can be trusted at the extremes: every result of several hundred fixed and many random
// scenes, beside the exact answer. Prints a table by kind of scene; exit status 1 if a single number is
// silently wrong.
//
//   bench_zoo [RANDOM] [MOST]    RANDOM random scenes (default 10000) of up to MOST disks (default 3)

#include <fmt/format.h>

#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "indet/packing/validate.h"
#include "indet/range/analyze.h"
#include "support/extremes.h"

int main(int argc, char** argv) {
  using namespace indet;
  const int count = argc > 1 ? std::atoi(argv[1]) : 10000;
  const int most = argc > 2 ? std::atoi(argv[2]) : 3;
  std::vector<std::string> order;
  std::map<std::string, std::pair<int, extremes::Tally>> table;
  extremes::Tally total;
  int scenes = 0;
  const auto visit = [&](const extremes::Scene& scene) {
    if (find_defect(scene.packing)) {
      fmt::print("{}, {}: refused by the validation: {}\n", scene.kind, scene.name,
                 find_defect(scene.packing)->reason);
      return;
    }
    extremes::Tally tally;
    try {
      tally = extremes::judge(scene, analyze(scene.packing));
    } catch (const std::exception& error) {
      fmt::print("{}, {}: {}\n", scene.kind, scene.name, error.what());
      ++tally.marked;
    }
    if (table.count(scene.kind) == 0) order.push_back(scene.kind);
    auto& [number, sum] = table[scene.kind];
    ++number;
    ++scenes;
    sum.add(tally);
    total.add(tally);
  };
  for (const extremes::Scene& scene : extremes::fixed_scenes()) visit(scene);
  for (int seed = 0; seed < count; ++seed)
    visit(extremes::random_scene(static_cast<std::uint64_t>(seed), most));

  const auto line = [](const std::string& name, int number, const extremes::Tally& tally) {
    const auto sum = static_cast<double>(tally.right + tally.contained + tally.marked + tally.wrong);
    fmt::print("| {:<38} | {:>6} | {:>7} | {:>9} | {:>6} | {:>5} | {:>6.1f} % |\n", name, number, tally.right,
               tally.contained, tally.marked, tally.wrong, 100 * static_cast<double>(tally.right) / sum);
  };
  fmt::print("| {:<38} | {:>6} | {:>7} | {:>9} | {:>6} | {:>5} | {:>8} |\n", "kind of scene", "scenes",
             "right", "contained", "marked", "wrong", "unmarked");
  fmt::print("|---|---|---|---|---|---|---|\n");
  for (const std::string& kind : order) line(kind, table[kind].first, table[kind].second);
  line("all", scenes, total);
  for (const std::string& complaint : total.complaints) fmt::print("WRONG {}\n", complaint);
  return total.wrong == 0 ? 0 : 1;
}
