#include "apps/paper_work.h"

#include <fmt/format.h>

#include "apps/command.h"
#include "apps/say.h"

namespace indet::app {

nlohmann::json describe_paper_work(const ForceRanges& ranges) {
  const PaperOptions& options = ranges.paper_options;
  const PaperWork& work = ranges.paper;
  nlohmann::json json = {{"neighbour_rule", to_string(options.neighbour)},
                         {"walk_start", to_string(options.start)},
                         {"walks", work.walk_count()},
                         {"failures", work.failures()},
                         {"extremal_points", work.points},
                         {"unexpected_points", work.unexpected},
                         {"neighbours", work.neighbours},
                         {"sliding_left", work.sliding_left},
                         {"starts", nlohmann::json::object()},
                         {"ends", nlohmann::json::object()}};
  if (options.neighbour == NeighbourRule::kRandom) json["walk_seed"] = options.seed;
  for (int end = 0; end < kInteriorEnds; ++end)
    json["starts"][to_string(static_cast<InteriorEnd>(end))] = work.starts[static_cast<std::size_t>(end)];
  for (int end = 0; end < kWalkEnds; ++end)
    json["ends"][to_string(static_cast<WalkEnd>(end))] = work.walks[static_cast<std::size_t>(end)];
  return json;
}

void print_paper_work(const PaperWork& work) {
  say("pivoting-paper: {} over {}, of which {} had an unexpected number of active constraints\n",
      counted(work.walk_count(), "walk"), counted(work.points, "extremal point"), work.unexpected);
  for (int end = 0; end < kInteriorEnds; ++end) {
    const std::int64_t blocks = work.starts[static_cast<std::size_t>(end)];
    if (blocks == 0) continue;
    const auto kind = static_cast<InteriorEnd>(end);
    if (kind == InteriorEnd::kFound) {
      say("  interior point: from the simulated state, by moving away from {}\n",
          counted(work.sliding_left, "sliding contact"));
    } else {
      say("  interior point: by a linear program in {} ({})\n", counted(blocks, "block"), to_string(kind));
    }
  }
  say("  {} failed, by the method's own account\n", counted(work.failures(), "walk"));
  for (int end = 0; end < kWalkEnds; ++end) {
    const std::int64_t walks = work.walks[static_cast<std::size_t>(end)];
    if (walks == 0 || static_cast<WalkEnd>(end) == WalkEnd::kNoneBetter) continue;
    say("    {:>6}  {}\n", walks, to_string(static_cast<WalkEnd>(end)));
  }
}

}  // namespace indet::app
