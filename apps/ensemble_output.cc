#include "apps/ensemble_output.h"

#include <fmt/format.h>

#include <iostream>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/ensemble/members/folder.h"
#include "apps/ensemble/presentation/figures.h"
#include "apps/ensemble/presentation/smallest_distance_summary.h"
#include "apps/ensemble/tables/ensemble_file.h"
#include "apps/say.h"
#include "apps/shared_run.h"

namespace indet::app {
void claim_folder(const std::filesystem::path& folder, const std::vector<Member>& members,
                  const Replacement& rule) {
  namespace fs = std::filesystem;
  std::error_code error;
  if (!fs::is_directory(folder, error)) return;
  rule.require(folder / "ensemble.toml", FileKind::kPlan);
  rule.require(folder / "ensemble.h5", FileKind::kEnsemble);
  const bool is_own = fs::exists(folder / "ensemble.toml", error);
  for (const Member& member : members) {
    const fs::path path = member_path(folder, member.name);
    if (!fs::is_regular_file(path, error)) continue;
    if (is_own) {
      rule.require_unread(path);
    } else {
      rule.require(path, FileKind::kMember);
    }
  }
}

int finish_ensemble(const std::filesystem::path& folder, const Plan& plan, Collection collection,
                    const BatchSummary& summary, const std::function<double()>& seconds,
                    const Context& context) {
  EnsembleContents contents{.config = plan.config,
                            .hash = plan.hash(),
                            .tables = std::move(collection.tables),
                            .missing = {},
                            .failures = summary.failures};
  for (const MissingMember& missing : collection.missing) {
    contents.missing.push_back(missing.member);
    if (!missing.reason.empty()) context.warn(missing.reason);
  }
  Provenance provenance{context.arguments, context.resolved_config, {}, {}};
  provenance.seconds["ensemble"] = seconds();
  const std::filesystem::path path = folder / "ensemble.h5";
  write_ensemble(path, contents, make_figures(contents.tables), provenance);

  const FlatTable& runs = contents.tables.runs;
  const double uncertain = runs.sum("imprecise") + runs.sum("failed");
  const std::string known = known_smallest_distances(contents.tables);
  if (context.json) {
    nlohmann::json json = {{"output", path.string()},
                           {"packings", runs.rows()},
                           {"contacts", contents.tables.contacts.rows()},
                           {"objectives", runs.sum("objectives")},
                           {"certified", runs.sum("certified")},
                           {"unbounded", runs.sum("unbounded")},
                           {"imprecise", runs.sum("imprecise")},
                           {"not_found", runs.sum("failed")},
                           {"done", summary.done},
                           {"skipped", summary.there_already},
                           {"missing", contents.missing},
                           {"failures", to_json(summary.failures, "member")},
                           {"seconds", seconds()}};
    if (!known.empty()) {
      json["smallest_distances"] = {{"known", runs.sum("d_min_known")},
                                    {"imprecise", runs.sum("d_min_imprecise")},
                                    {"failed", runs.sum("d_min_failed")}};
    }
    std::cout << json.dump(2) << '\n';
  } else if (context.prints_report()) {
    say("{}: {} computed, {} there already, {} failed\n",
        counted(static_cast<std::int64_t>(plan.members.size()), "packing"), summary.done,
        summary.there_already, summary.failures.size());
    const double unbounded = runs.sum("unbounded");
    say("{}, {} extrema: {} certified{}, {} imprecise, {} failed\n",
        counted(static_cast<std::int64_t>(contents.tables.contacts.rows()), "contact"),
        runs.sum("objectives"), runs.sum("certified"),
        unbounded > 0 ? fmt::format(" ({} of them unbounded)", unbounded) : "", runs.sum("imprecise"),
        runs.sum("failed"));
    if (!known.empty()) say("smallest distances: {}\n", known);
    for (const std::string& name : contents.missing) say("missing: {}\n", name);
    say("written to {} ({:.1f} s)\n", path.string(), seconds());
  }
  return contents.missing.empty() && uncertain == 0 ? kDone : kUncertain;
}

}  // namespace indet::app
