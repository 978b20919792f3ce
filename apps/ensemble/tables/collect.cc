#include "apps/ensemble/tables/collect.h"

#include <fmt/format.h>

#include <string>

#include "apps/ensemble/members/folder.h"
#include "apps/ensemble/members/member_file.h"
#include "apps/ensemble/tables/contact_table.h"
#include "apps/ensemble/tables/protocol_distances.h"
#include "apps/ensemble/tables/reaction_table.h"
#include "apps/ensemble/tables/run_table.h"
#include "apps/ensemble/tables/uniform_tables.h"
#include "libindet/base/error.h"
#include "libindet/io/packing_file.h"

namespace indet {
namespace {

class Collector {
 public:
  explicit Collector(EnsembleTables& tables) : tables_(tables) {}

  void add(const Member& member, const std::filesystem::path& path) {
    const Hdf5File file = open_indet_file(path);
    const Packing packing = read_packing(file);
    const std::size_t run = add_run(member, file, packing, tables_);
    const std::size_t first_contact = tables_.contacts.rows();
    add_contacts(file, packing, run, tables_);
    add_reactions(file, packing, run, tables_.reactions);
    add_uniform_sampling(file, tables_, run, first_contact);
    distances_.add(member, packing, run, tables_.runs);
  }

 private:
  EnsembleTables& tables_;
  ProtocolDistances distances_;
};

}  // namespace

Collection collect_members(const Plan& plan, const std::vector<std::filesystem::path>& folders,
                           const ProgressCallback& progress) {
  Collection collection;
  Collector collector(collection.tables);
  for (const Member& member : plan.members) {
    if (progress && !progress({.stage = "collecting",
                               .done = member.number,
                               .total = static_cast<std::int64_t>(plan.members.size()),
                               .details = {}}))
      throw Interrupted();
    std::filesystem::path found;
    std::string reason;
    for (const std::filesystem::path& folder : folders) {
      const std::filesystem::path path = member_path(folder, member.name);
      const ItemState state = examine_member(path, member);
      if (state.status != ItemStatus::kDone) {
        if (!state.reason.empty()) reason = state.reason;
        continue;
      }
      if (!found.empty() && !std::filesystem::equivalent(path, found)) {
        throw InputError(
            fmt::format("{} is in two parts: {} and {}", member.name, found.string(), path.string()));
      }
      found = path;
    }
    if (found.empty()) {
      collection.missing.push_back({member.name, reason});
    } else {
      collector.add(member, found);
    }
  }
  return collection;
}

void read_member(const std::filesystem::path& path) {
  EnsembleTables tables;
  Collector(tables).add(Member{}, path);
}

}  // namespace indet
