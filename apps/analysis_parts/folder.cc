#include "apps/analysis_parts/folder.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include "libindet/base/error.h"
#include "libindet/base/toml_text.h"
#include "libindet/io/whole_file.h"

namespace indet {
namespace {

namespace fs = std::filesystem;

fs::path plan_path(const fs::path& folder) { return folder / "analysis.toml"; }

std::string text_of(const AnalysisPlan& plan) {
  std::string text =
      "# The parts of this analysis. Written by indet; indet merge and indet status read it.\n";
  text += fmt::format("version = {}\npacking = \"{}\"\noptions = {}\ncontacts = \"{}\"\n",
                      toml_text(plan.version), plan.packing, toml_text(plan.options),
                      to_string(plan.contacts.kind));
  for (const Chunk& chunk : plan.chunks)
    text += fmt::format("[[chunk]]\nname = \"{}\"\ncontacts = \"{}\"\ncost = {:.3f}\n", chunk.name,
                        to_list(chunk.contacts), chunk.cost);
  return text;
}

}  // namespace

void write_analysis_plan(const fs::path& folder, const AnalysisPlan& plan) {
  keep_whole_file(plan_path(folder), text_of(plan));
}

bool has_analysis_plan(const fs::path& folder) {
  std::error_code error;
  return fs::exists(plan_path(folder), error);
}

AnalysisPlan read_analysis_plan(const fs::path& folder) {
  const std::string path = plan_path(folder).string();
  if (!has_analysis_plan(folder)) {
    throw InputError(fmt::format("{} is not the folder of an analysis in parts: it has no analysis.toml",
                                 folder.string()));
  }
  toml::table table;
  try {
    table = toml::parse_file(path);
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}:{}: {}", path, error.source().begin.line, error.description()));
  }
  const auto fail = [&](const std::string& what) { throw InputError(fmt::format("{}: {}", path, what)); };
  AnalysisPlan plan;
  plan.version = table["version"].value_or(std::string());
  plan.packing = table["packing"].value_or(std::string());
  plan.options = table["options"].value_or(std::string());
  const std::string contacts = table["contacts"].value_or(std::string());
  if (plan.packing.size() != 64) fail("names no packing");
  if (contacts == to_string(ContactChoice::Kind::kList)) {
    plan.contacts.kind = ContactChoice::Kind::kList;
  } else if (contacts != to_string(ContactChoice::Kind::kAll)) {
    fail("does not say whether it is of all contacts or of a list");
  }
  const toml::array* chunks = table["chunk"].as_array();
  if (chunks == nullptr) fail("lists no parts; the indet analyze command that made it writes it anew");
  for (const toml::node& node : *chunks) {
    const toml::table* entry = node.as_table();
    if (entry == nullptr) fail("a part is not a table");
    Chunk chunk;
    chunk.name = (*entry)["name"].value_or(std::string());
    chunk.contacts = from_list((*entry)["contacts"].value_or(std::string()));
    chunk.cost = (*entry)["cost"].value_or(0.0);
    if (chunk.name.empty() || chunk.name.find('/') != std::string::npos || chunk.contacts.empty())
      fail("a part has no name or no contacts");
    if (plan.contacts.kind == ContactChoice::Kind::kList)
      plan.contacts.list.insert(plan.contacts.list.end(), chunk.contacts.begin(), chunk.contacts.end());
    plan.chunks.push_back(std::move(chunk));
  }
  return plan;
}

fs::path chunks_folder(const fs::path& folder) { return folder / "chunks"; }

fs::path chunk_path(const fs::path& folder, const Chunk& chunk) {
  return chunks_folder(folder) / (chunk.name + ".h5");
}

std::vector<fs::path> chunk_paths(const fs::path& folder, const AnalysisPlan& plan) {
  std::vector<fs::path> paths;
  for (const Chunk& chunk : plan.chunks) paths.push_back(chunk_path(folder, chunk));
  return paths;
}

fs::path joined_path(const fs::path& folder) { return folder / "ranges.h5"; }

}  // namespace indet
