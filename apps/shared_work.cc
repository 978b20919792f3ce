#include "apps/shared_work.h"

#include <memory>

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
  work.is_collected =
      is_newer(work.result, members_folder(folder)) && is_newer(work.result, folder / "ensemble.toml");
  return work;
}

}  // namespace

SharedWork shared_work_of(const fs::path& folder) { return ensemble_in(folder); }

}  // namespace indet::app
