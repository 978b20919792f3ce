#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/ensemble/members/plan.h"

namespace indet {

/// The folder of an ensemble: ensemble.toml says which members it has, members/NAME.h5 is what was found
/// about one, and ensemble.h5 and figures/ are made from these. Several processes may write into it; each
/// file appears whole.

/// Throws InputError if the members of this folder lie in units/, where earlier versions put them.
void check_layout(const std::filesystem::path& folder);

/// FOLDER/ensemble.toml: which members an ensemble has, so that parts can be joined and missing ones be
/// named. Left alone where it says so already.
void write_plan(const std::filesystem::path& folder, const Plan& plan);
/// Throws InputError. `config` of the members is not stored.
Plan read_plan(const std::filesystem::path& folder);

/// FOLDER/members, with one file a member.
std::filesystem::path members_folder(const std::filesystem::path& folder);
std::filesystem::path checkpoint_path(const std::filesystem::path& folder, const std::string& name);
std::filesystem::path member_path(const std::filesystem::path& folder, const std::string& name);
/// Those of these members in each of the folders, whether there is a file or not.
std::vector<std::filesystem::path> member_paths(const std::vector<std::filesystem::path>& folders,
                                                const std::vector<Member>& members);

}  // namespace indet
