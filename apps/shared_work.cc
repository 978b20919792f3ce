#include "apps/shared_work.h"

#include <memory>

#include "apps/analysis_parts/chunk_file.h"
#include "apps/analysis_parts/folder.h"
#include "apps/ensemble/members/folder.h"
#include "apps/ensemble/members/member_file.h"

namespace indet::app {
namespace {

namespace fs = std::filesystem;

/// Whether the file is there and not older than another one, or than the last name that appeared in a folder.
bool is_newer(const fs::path& file, const fs::path& other) {
  std::error_code error;
  const auto written = fs::last_write_time(file, error);
  if (error) return false;
  const auto changed = fs::last_write_time(other, error);
  return !error && written >= changed;
}

/// The result is there, of these items and this plan.
bool is_collected(const SharedWork& work, const fs::path& plan) {
  return is_newer(work.result, work.expected.results) && is_newer(work.result, plan);
}

SharedWork ensemble_in(const fs::path& folder) {
  const auto plan = std::make_shared<const Plan>(read_plan(folder));
  SharedWork work{.folder = folder,
                  .kind = "ensemble",
                  .item = "packing",
                  .items = "packings",
                  .expected = {},
                  .result = folder / "ensemble.h5",
                  .collector = "the same indet ensemble command without --shard"};
  work.expected.digest = plan->hash();
  work.expected.results = members_folder(folder);
  for (const Member& member : plan->members) work.expected.items.push_back({member.name, member.cost});
  work.expected.is_done = [plan, folder](std::size_t item) {
    const Member& member = plan->members[item];
    return member_is_done(member_path(folder, member.name), member);
  };
  work.is_collected = is_collected(work, folder / "ensemble.toml");
  return work;
}

SharedWork analysis_in(const fs::path& folder) {
  const auto plan = std::make_shared<const AnalysisPlan>(read_analysis_plan(folder));
  SharedWork work{.folder = folder,
                  .kind = "analysis",
                  .item = "part",
                  .items = "parts",
                  .expected = {},
                  .result = joined_path(folder),
                  .collector = "the same indet analyze command without --shard"};
  work.expected.digest = plan->hash();
  work.expected.results = chunks_folder(folder);
  for (const Chunk& chunk : plan->chunks) work.expected.items.push_back({chunk.name, chunk.cost});
  work.expected.is_done = [plan, folder](std::size_t item) {
    return chunk_is_done(chunk_path(folder, plan->chunks[item]), *plan);
  };
  work.is_collected = is_collected(work, folder / "analysis.toml");
  return work;
}

}  // namespace

SharedWork shared_work_of(const fs::path& folder) {
  return has_analysis_plan(folder) ? analysis_in(folder) : ensemble_in(folder);
}

}  // namespace indet::app
