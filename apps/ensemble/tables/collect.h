#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/ensemble/members/plan.h"
#include "apps/ensemble/tables/ensemble_tables.h"
#include "libindet/base/progress.h"

namespace indet {

struct MissingMember {
  std::string member;
  std::string reason;  ///< Why its file does not count; "" if there is none.
};

/// What a plan asks for and what is there.
struct Collection {
  EnsembleTables tables;
  std::vector<MissingMember> missing;
};

/// Reads the member files of `folders` (parts of one ensemble). Throws InputError if a member is in two
/// folders that are not the same one; Interrupted.
Collection collect_members(const Plan& plan, const std::vector<std::filesystem::path>& folders,
                           const ProgressCallback& progress = {});

/// Reads of the file of a member what collect_members would read, and forgets it. Throws as that does.
void read_member(const std::filesystem::path& path);

}  // namespace indet
