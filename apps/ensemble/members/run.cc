#include "apps/ensemble/members/run.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <random>
#include <utility>

#include "apps/ensemble/members/folder.h"
#include "apps/ensemble/members/member_file.h"
#include "libindet/base/error.h"
#include "libindet/base/random.h"
#include "libindet/io/destination.h"
#include "libindet/io/whole_file.h"

namespace indet {
namespace {

class MemberBatch {
 public:
  MemberBatch(const EnsembleConfig& config, const Plan& plan, const std::vector<Member>& members,
              const std::filesystem::path& folder, const RunOptions& options)
      : config_(config), folder_(folder), options_(options) {
    for (const Member& member : plan.members) {
      if (member.protocol == sim::Protocol::kCd1) starts_[member.seed] = &member;
    }
    for (const Member& member : members) {
      const ItemState state = examine_member(member_path(folder, member.name), member);
      if (state.status == ItemStatus::kUnreadable && options.warn)
        options.warn(state.reason + "; it is computed again");
      if (state.status == ItemStatus::kDone) {
        ++batch_.there_already;
      } else {
        open_.push_back(&member);
      }
    }
    Random random(std::random_device{}());
    for (std::size_t i = open_.size(); i > 1; --i) std::swap(open_[i - 1], open_[random.below(i)]);
    std::stable_sort(open_.begin(), open_.end(),
                     [](const Member* a, const Member* b) { return a->cost > b->cost; });
    add_items();
    batch_.is_done = [this](std::size_t item) { return is_done(*open_[item]); };
    batch_.compute = [this](std::size_t item, const ProgressCallback& progress) {
      return compute(*open_[item], progress);
    };
  }

  BatchSummary run() {
    return run_items(batch_, {.threads = options_.threads,
                              .stage = "ensemble",
                              .items = "packings",
                              .progress = options_.progress,
                              .time_budget = options_.time_budget,
                              .log = options_.log});
  }

 private:
  void add_items() {
    std::map<std::int64_t, std::size_t> open_starts;  // by seed
    for (std::size_t i = 0; i < open_.size(); ++i) {
      if (open_[i]->protocol == sim::Protocol::kCd1) open_starts[open_[i]->seed] = i;
    }
    for (const Member* member : open_) {
      WorkItem item{member->name, member->cost};
      const auto start = open_starts.find(member->seed);
      if (starts_from_cd1(member->protocol) && start != open_starts.end()) item.after = start->second;
      batch_.items.push_back(std::move(item));
    }
  }

  std::map<std::string, double> compute(const Member& member, const ProgressCallback& progress) {
    const MemberCheckpoint checkpoint(folder_, member, options_.checkpoints, options_.provenance, hdf5_);
    const MemberResult result =
        compute_member(config_, member, source(member), start(member), checkpoint, progress);
    const std::scoped_lock lock(hdf5_);
    const std::filesystem::path path = member_path(folder_, member.name);
    if (!member_is_done(path, member)) write_member(path, member, result, options_.provenance);
    checkpoint.remove();
    return result.seconds;
  }

  bool is_done(const Member& member) {
    const std::scoped_lock lock(hdf5_);
    return member_is_done(member_path(folder_, member.name), member);
  }

  std::optional<Packing> source(const Member& member) {
    if (member.source.empty()) return std::nullopt;
    const std::scoped_lock lock(hdf5_);
    return read_packing(member.source);
  }

  /// The cd1 packing of the same seed, if it is there already.
  std::optional<Packing> start(const Member& member) {
    const auto found = starts_.find(member.seed);
    if (!starts_from_cd1(member.protocol) || found == starts_.end()) return std::nullopt;
    const std::filesystem::path path = member_path(folder_, found->second->name);
    const std::scoped_lock lock(hdf5_);
    if (!member_is_done(path, *found->second)) return std::nullopt;
    return read_packing(path);
  }

  const EnsembleConfig& config_;
  const std::filesystem::path& folder_;
  const RunOptions& options_;
  std::map<std::int64_t, const Member*> starts_;  ///< The cd1 members of the plan by seed.
  std::vector<const Member*> open_;
  Batch batch_;
  std::mutex hdf5_;
};

}  // namespace

BatchSummary compute_members(const EnsembleConfig& config, const Plan& plan,
                             const std::vector<Member>& members, const std::filesystem::path& folder,
                             const RunOptions& options) {
  make_folder(members_folder(folder));
  remove_leftovers(folder);
  remove_leftovers(members_folder(folder));
  return MemberBatch(config, plan, members, folder, options).run();
}

}  // namespace indet
