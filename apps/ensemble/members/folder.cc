#include "apps/ensemble/members/folder.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include "libindet/base/error.h"
#include "libindet/base/toml_text.h"
#include "libindet/io/whole_file.h"

namespace indet {

void check_layout(const std::filesystem::path& folder) {
  std::error_code ignored;
  const std::filesystem::path old = folder / "units";
  if (!std::filesystem::is_directory(old, ignored)) return;
  if (std::filesystem::exists(members_folder(folder), ignored)) return;
  throw InputError(
      fmt::format("{} is an ensemble of an earlier indet; rename {} to {} and run the same indet ensemble "
                  "command again, which takes what is there",
                  folder.string(), old.string(), members_folder(folder).string()));
}

void write_plan(const std::filesystem::path& folder, const Plan& plan) {
  std::string text =
      "# The packings of this ensemble. Written by indet; indet merge and indet report read it.\n";
  text += fmt::format("config = {}\n", toml_text(plan.config));
  for (const Member& member : plan.members) {
    text += fmt::format("[[member]]\nname = {}\nprotocol = \"{}\"\nseed = {}\ncost = {:.3f}\nhash = \"{}\"\n",
                        toml_text(member.name), to_string(member.protocol), member.seed, member.cost,
                        member.hash);
  }
  keep_whole_file(folder / "ensemble.toml", text);
}

Plan read_plan(const std::filesystem::path& folder) {
  check_layout(folder);
  const std::string path = (folder / "ensemble.toml").string();
  if (!std::filesystem::exists(path)) {
    throw InputError(
        fmt::format("{} is not the folder of an ensemble: it has no ensemble.toml", folder.string()));
  }
  toml::table table;
  try {
    table = toml::parse_file(path);
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}:{}: {}", path, error.source().begin.line, error.description()));
  }
  Plan plan;
  const auto fail = [&](const char* what) { throw InputError(fmt::format("{}: {}", path, what)); };
  plan.config = table["config"].value_or(std::string());
  const toml::array* members = table["member"].as_array();
  if (members == nullptr) fail("lists no members; the indet ensemble command that made it writes it anew");
  for (const toml::node& node : *members) {
    const toml::table* entry = node.as_table();
    if (entry == nullptr) fail("a member is not a table");
    Member member;
    member.number = static_cast<int>(plan.members.size());
    member.name = (*entry)["name"].value_or(std::string());
    member.seed = (*entry)["seed"].value_or(std::int64_t{-1});
    member.cost = (*entry)["cost"].value_or(0.0);
    member.hash = (*entry)["hash"].value_or(std::string());
    if (member.name.empty() || member.name.find('/') != std::string::npos || member.hash.size() != 64)
      fail("a member has no name or no hash");
    const auto protocol = sim::protocol_from((*entry)["protocol"].value_or(std::string()));
    if (!protocol) fail("a member has no protocol, or one that is unknown");
    member.protocol = *protocol;
    plan.members.push_back(member);
  }
  return plan;
}

std::filesystem::path members_folder(const std::filesystem::path& folder) { return folder / "members"; }

std::filesystem::path member_path(const std::filesystem::path& folder, const std::string& name) {
  return members_folder(folder) / (name + ".h5");
}

std::filesystem::path checkpoint_path(const std::filesystem::path& folder, const std::string& name) {
  return folder / "checkpoints" / (name + ".h5");
}

std::vector<std::filesystem::path> member_paths(const std::vector<std::filesystem::path>& folders,
                                                const std::vector<Member>& members) {
  std::vector<std::filesystem::path> paths;
  for (const std::filesystem::path& folder : folders) {
    for (const Member& member : members) paths.push_back(member_path(folder, member.name));
  }
  return paths;
}

}  // namespace indet
