#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/command.h"
#include "apps/ensemble/members/folder.h"
#include "apps/ensemble/presentation/html_report.h"
#include "apps/output_files.h"
#include "apps/say.h"
#include "apps/trial_reading.h"
#include "libindet/base/error.h"
#include "libindet/drawing/packing_picture.h"
#include "libindet/io/destination.h"
#include "libindet/io/ranges_file.h"

namespace indet::app {
namespace {

namespace fs = std::filesystem;

/// Fig. 5: CD-1, MD-2 and the extremal state of largest norm, for the first seed that has both files.
std::vector<Picture> draw_states(const fs::path& folder, const EnsembleTables& tables) {
  std::vector<Picture> pictures;
  const std::vector<sim::Protocol> protocols = protocols_of(tables.runs);
  for (std::size_t row = 0; row < tables.runs.rows(); ++row) {
    if (protocols[row] != sim::Protocol::kCd1) continue;
    const std::string name = tables.runs.text("member", row);
    const auto seed = static_cast<std::int64_t>(tables.runs.number("seed", row));
    const fs::path first = member_path(folder, name);
    const fs::path second = member_path(folder, simulated_name(sim::Protocol::kMd2, seed));
    if (!fs::exists(first) || !fs::exists(second)) continue;
    const Hdf5File file = open_on_trial(first);
    const Packing cd1 = read_packing(file);
    const Packing md2 = read_packing(open_on_trial(second));
    const ForceRanges ranges = read_ranges(file);
    if (ranges.largest_norm < 0) continue;
    const fs::path figures = folder / "figures";
    draw_forces(figures / "fig05a.svg", cd1, cd1.simulated_forces().value(), name);
    draw_forces(figures / "fig05b.svg", md2, md2.simulated_forces().value(), second.stem().string());
    draw_forces(figures / "fig05c.svg", cd1, ranges.states.row(ranges.largest_norm).transpose(),
                "extremal state");
    const double mg = cd1.force_unit();
    pictures.push_back({"fig05a", fmt::format("CD-1: {} contacts, norm {:.0f} mg", cd1.contact_count(),
                                              cd1.simulated_forces().value().norm() / mg)});
    pictures.push_back(
        {"fig05b", fmt::format("MD-2 from it: {} contacts, norm {:.0f} mg", md2.contact_count(),
                               md2.simulated_forces().value().norm() / mg)});
    pictures.push_back(
        {"fig05c", fmt::format("The extremal state of the CD-1 packing of largest norm, {:.0f} mg",
                               ranges.norm[ranges.largest_norm] / mg)});
    break;
  }
  return pictures;
}

struct ReportCommand {
  std::string folder;
  bool overwrite = false;
};

int run(const ReportCommand& o, const Context& context) {
  const fs::path folder = o.folder;
  check_layout(folder);
  if (!fs::exists(folder / "ensemble.h5")) {
    throw InputError(
        fmt::format("{}: has no ensemble.h5; make one with indet ensemble or indet merge", o.folder));
  }
  const Hdf5File file = open_on_trial(folder / "ensemble.h5");
  const EnsembleContents contents = read_ensemble(file);
  std::vector<std::pair<std::string, std::string>> about;
  for (const char* name : {"version", "git", "compiler", "host", "created"})
    about.emplace_back(name, file.string_attribute("/provenance", name));
  about.emplace_back("SHA-256 of the numbers", file.string_attribute("/", "content_sha256"));
  const Replacement rule = replacement_rule({file.path()}, o.overwrite, context);
  rule.require(folder / "report.html", FileKind::kReport);
  rule.require_folder(folder / "figures", "comparison.csv");
  make_folder(folder / "figures");
  const std::vector<Picture> pictures = draw_states(folder, contents.tables);
  write_report(folder, contents, pictures, about, context.progress());
  const std::string report = (folder / "report.html").string();
  if (context.json) {
    std::cout << nlohmann::json{{"report", report}, {"packings", contents.tables.runs.rows()}}.dump(2)
              << '\n';
  } else if (context.prints_report()) {
    say("written to {}\n", report);
  }
  return kDone;
}

}  // namespace

Command add_report(CLI::App& root) {
  const auto o = std::make_shared<ReportCommand>();
  CLI::App* command =
      root.add_subcommand("report", "Make the figures and tables of an ensemble, as one HTML page");
  command->add_option("folder", o->folder, "Folder of an ensemble, from indet ensemble or merge")
      ->required()
      ->check(CLI::ExistingDirectory);
  add_overwrite_option(*command, o->overwrite);
  return {command, [o](const Context& context) { return run(*o, context); }};
}

}  // namespace indet::app
