#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/command.h"
#include "apps/estimate_report.h"
#include "apps/kept_states.h"
#include "apps/output_files.h"
#include "apps/packing_input.h"
#include "apps/say.h"
#include "libindet/base/error.h"
#include "libindet/drawing/mechanism_picture.h"
#include "libindet/drawing/packing_picture.h"
#include "libindet/drawing/steps_picture.h"
#include "libindet/drawing/yield_curve.h"
#include "libindet/io/csv_writer.h"
#include "libindet/io/limits_file.h"
#include "libindet/io/ovito_files.h"
#include "libindet/io/ranges_file.h"
#include "libindet/io/table.h"
#include "libindet/io/vtkhdf.h"

namespace indet::app {
namespace {

constexpr std::array kFormats = {"csv", "svg", "pdf", "png", "vtkhdf", "extxyz"};

struct ExportOptions {
  std::string file;
  std::string format;
  std::string state = "sim";
  std::string style = "forces";
  std::string limit = "largest";
  std::string output;
  bool overwrite = false;
};

/// A contact state and how a caption calls it.
struct ChosenState {
  Eigen::VectorXd forces;
  std::string description;
};

/// What --limit says: which end of which limit of the file.
struct LimitName {
  std::int64_t number = 0;
  bool is_largest = true;
};
std::optional<LimitName> parse_limit(const std::string& text) {
  LimitName name;
  std::string end = text;
  if (const std::size_t colon = text.find(':'); colon != std::string::npos) {
    if (!parse_number(std::string_view(text).substr(0, colon), &name.number) || name.number < 0) return {};
    end = text.substr(colon + 1);
  }
  if (end != "largest" && end != "smallest") return {};
  name.is_largest = end == "largest";
  return name;
}

/// A limit of the file, and which end of it is meant.
struct ChosenLimit {
  Limit limit;
  bool is_largest = true;

  const LimitEnd& end() const { return is_largest ? limit.largest : limit.smallest; }
  std::string description() const {
    if (end().outcome != LimitOutcome::kReached)
      return fmt::format("{} {}: {}", limit.name, is_largest ? "largest" : "smallest",
                         to_string(end().outcome));
    const bool is_angle = limit.kind == LimitKind::kTilt;
    return fmt::format("{} of {:.5g}{}", limit.name,
                       is_angle ? end().value * 180 / std::numbers::pi : end().value, is_angle ? "°" : "");
  }
};

ChosenLimit choose_limit(const ExportOptions& options, const Hdf5File& file, const std::string& what) {
  if (!has_limits(file))
    throw InputError(
        fmt::format("{0}: {1} needs limits; compute them first: indet limit {0} --tilt", options.file, what));
  const LimitName name = parse_limit(options.limit).value();
  std::vector<Limit> limits = read_limits(file);
  if (name.number >= std::ssize(limits))
    throw InputError(fmt::format("{}: there is no limit {}; the file has {}", options.file, name.number,
                                 counted(std::ssize(limits), "limit")));
  return {std::move(limits[static_cast<std::size_t>(name.number)]), name.is_largest};
}

const ForceRanges& need_ranges(const std::optional<ForceRanges>& ranges, const std::string& file,
                               const std::string& what) {
  if (ranges) return *ranges;
  throw InputError(
      fmt::format("{0}: {1} needs force ranges; compute them first: indet analyze {0}", file, what));
}

/// What --state says: its kind ("sim", "max-norm", "state", "R_min", …) and the number after the colon.
struct StateName {
  std::string kind;
  std::int64_t number = -1;
};

std::optional<StateName> parse_state(const std::string& text) {
  if (text == "sim" || text == "max-norm" || text == "limit") return StateName{text};
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) return {};
  StateName name{text.substr(0, colon)};
  if (!parse_number(std::string_view(text).substr(colon + 1), &name.number) || name.number < 0) return {};
  for (const char* kind : {"state", "R_min", "R_max", "T_min", "T_max"}) {
    if (name.kind == kind) return name;
  }
  return {};
}

ChosenState choose_state(const ExportOptions& options, const Hdf5File& file, const Packing& packing,
                         const std::optional<ForceRanges>& ranges) {
  const StateName name = parse_state(options.state).value();
  if (name.kind == "limit") {
    const ChosenLimit chosen = choose_limit(options, file, "--state limit");
    const Eigen::VectorXd& forces = chosen.end().forces.value();
    if (forces.size() == 0)
      throw InputError(
          fmt::format("{}: no contact forces are known there: {}", options.file, chosen.description()));
    return {forces, "state at " + chosen.description()};
  }
  if (name.kind == "sim") {
    Eigen::VectorXd forces = packing.simulated_forces().value();
    const auto known = forces.array().isFinite().count();
    std::string description = known == forces.size() ? "simulated state"
                              : known > 0 ? fmt::format("{} of {} forces known", known, forces.size())
                                          : "forces unknown";
    return {std::move(forces), std::move(description)};
  }
  const ForceRanges& r = need_ranges(ranges, options.file, "--state " + options.state);
  const auto row = [&](std::int64_t k, const std::string& description) -> ChosenState {
    const bool keeps_all =
        r.state_kind != StateChoice::Kind::kNone && r.states_of == StateChoice::Contacts::kAll;
    if ((k < 0 || k >= r.states.rows()) && !keeps_all) {
      throw InputError(fmt::format("{}: there is no extremal state for --state {}: {}", options.file,
                                   options.state, describe_missing_states(r)));
    }
    if (k < 0 || k >= r.states.rows()) {
      throw InputError(fmt::format("{}: there is no extremal state for --state {}; the file has {}",
                                   options.file, options.state, counted(r.states.rows(), "extremal state")));
    }
    return {r.states.row(k).transpose(), description};
  };
  if (name.kind == "max-norm") {
    return row(r.largest_norm,
               fmt::format("extremal state of largest norm{}",
                           r.states_of == StateChoice::Contacts::kAll ? "" : " of those kept"));
  }
  if (name.kind == "state") return row(name.number, fmt::format("extremal state {}", name.number));
  if (name.number >= packing.contact_count()) {
    throw InputError(
        fmt::format("--state {}: the contacts are 0 … {}", options.state, packing.contact_count() - 1));
  }
  Column column = kMinR;
  for (const Column other : {kMaxR, kMinT, kMaxT}) {
    if (name.kind == to_string(other)) column = other;
  }
  return row(r.vertex(name.number, column),
             fmt::format("extremal state of {} of contact {}", name.kind, name.number));
}

std::string caption(const ExportOptions& options, const Packing& packing, const std::string& description) {
  std::string text =
      fmt::format("{}: {}, N = {}, M = {}", std::filesystem::path(options.file).filename().string(),
                  packing.origin.protocol, packing.disk_count(), packing.contact_count());
  if (packing.origin.seed >= 0) text += fmt::format(", seed {}", packing.origin.seed);
  return text + "; " + description;
}

/// The format: as asked for, else that of the extension of the output, else a picture.
std::string resolve_format(const ExportOptions& options) {
  const std::string extension = std::filesystem::path(options.output).extension().string();
  if (!options.format.empty()) {
    if (options.format != "csv" && !extension.empty() && extension != "." + options.format) {
      throw InputError(fmt::format("{}: must end with .{}", options.output, options.format));
    }
    return options.format;
  }
  return extension.empty() ? "svg" : extension.substr(1);
}

/// A picture, a table, files of other programs, or the files of a scene in a folder that may be there.
void claim_outputs(const std::filesystem::path& output, const std::string& format, const Replacement& rule) {
  if (format == "vtkhdf") return claim_output(output, FileKind::kVtk, rule);
  if (format == "extxyz") {
    claim_output(output, FileKind::kParticles, rule);
    return claim_output(bonds_path_of(output), FileKind::kBonds, rule);
  }
  if (format != "csv") return claim_output(output, FileKind::kPicture, rule);
  if (output.extension() == ".csv") return claim_output(output, FileKind::kContactTable, rule);
  if (!std::filesystem::is_directory(output)) return;  // made, or refused, by the writer
  for (const char* name : kSceneFiles) claim_output(output / name, FileKind::kCsvScene, rule);
}

/// All formats but those of pictures.
void write_numbers(const std::filesystem::path& output, const std::string& format, const Packing& packing,
                   const ChosenState& state, const ForceRanges* ranges, const Context& context) {
  if (format == "vtkhdf") {
    write_vtkhdf(output, packing, state.forces, ranges, {context.arguments, context.resolved_config, {}, {}});
  } else if (format == "extxyz") {
    write_ovito_files(output, packing, state.forces, ranges);
  } else if (output.extension() == ".csv") {
    write_contact_table(output, packing, state.forces, ranges);
  } else {
    write_csv_scene(output, packing, state.forces);
  }
}

/// The motion at a limit, or of a packing that cannot stand.
void export_mechanism(const std::filesystem::path& output, const ExportOptions& options, const Hdf5File& file,
                      const Packing& packing, const std::optional<ForceRanges>& ranges) {
  if (!has_limits(file) && ranges && ranges->motion.rows() > 0) {
    const exact::BodyMotion motion{ranges->motion, ranges->wall_motion, ranges->cell_motion,
                                   ranges->bound_multipliers};
    draw_mechanism(output, packing, motion, caption(options, packing, "how it falls"));
    return;
  }
  const ChosenLimit chosen = choose_limit(options, file, "--style mechanism");
  if (chosen.end().motion.disks.rows() == 0)
    throw InputError(fmt::format("{}: nothing moves there: {}", options.file, chosen.description()));
  draw_mechanism(output, under_mechanism(packing, chosen.limit, chosen.end()), chosen.end().motion,
                 caption(options, packing, "mechanism at " + chosen.description()));
}

void export_yield_curve(const std::filesystem::path& output, const ExportOptions& options,
                        const Hdf5File& file, const Packing& packing) {
  std::vector<Limit> limits;
  if (has_limits(file)) limits = read_limits(file);
  std::erase_if(limits, [](const Limit& limit) { return std::isnan(limit.map_angle); });
  if (limits.empty())
    throw InputError(
        fmt::format("{0}: --style yield-curve needs a map of two loads; make it first: indet limit {0} "
                    "--load … --load … --map 36",
                    options.file));
  draw_yield_curve(output, limits, caption(options, packing, "multiples of two loads at which it yields"));
}

void export_steps(const std::filesystem::path& output, const ExportOptions& options, const Hdf5File& file,
                  const Packing& packing) {
  const ChosenLimit chosen = choose_limit(options, file, "--style steps");
  const LimitEnd& end = chosen.end();
  if (end.steps.empty())
    throw InputError(
        fmt::format("{}: there are no steps to {}; --steps of indet limit makes them, if there is a way",
                    options.file, chosen.description()));
  std::string text = fmt::format("on the way to {}, relative to its beginning; dim F = {}",
                                 chosen.description(), end.steps.front().dim);
  if (end.dim >= 0) text += fmt::format(", at the limit {}", end.dim);
  draw_steps(output, chosen.limit, end, caption(options, packing, text));
}

int run(ExportOptions options, const Context& context) {
  const Hdf5File file = open_packing(options.file);
  const Packing packing = read_packing(file);
  std::optional<ForceRanges> ranges;
  if (has_ranges(file)) ranges = read_ranges(file);
  const std::string format = resolve_format(options);
  if (std::find(kFormats.begin(), kFormats.end(), format) == kFormats.end())
    throw InputError(fmt::format("{}: the formats are {}", options.output, fmt::join(kFormats, ", ")));
  const bool is_picture = format == "svg" || format == "pdf" || format == "png";
  if (!is_picture && options.style != "forces") {
    throw InputError(fmt::format("--style has no effect on {}, which has all numbers; it is for pictures",
                                 format == "csv" ? "CSV" : format));
  }
  if (options.output.empty()) {
    options.output = std::filesystem::path(options.file).stem().string() + "." + format;
  }
  if (format == "extxyz" && std::filesystem::path(options.output).extension() != ".extxyz") {
    throw InputError(fmt::format(
        "{}: must end with .extxyz, for the bonds go to a second file, of this name with .bonds.dump",
        options.output));
  }
  const ChosenState state = choose_state(options, file, packing, ranges);
  const std::filesystem::path output = options.output;
  claim_outputs(output, format, replacement_rule({options.file}, options.overwrite, context));
  if (!is_picture) {
    write_numbers(output, format, packing, state, ranges ? &*ranges : nullptr, context);
  } else if (options.style == "yield-curve") {
    export_yield_curve(output, options, file, packing);
  } else if (options.style == "steps") {
    export_steps(output, options, file, packing);
  } else if (options.style == "mechanism") {
    export_mechanism(output, options, file, packing, ranges);
  } else if (options.style == "delta-R") {
    const ForceRanges& r = need_ranges(ranges, options.file, "--style delta-R");
    const std::string range = "range of the normal force of each contact";
    draw_delta_R(output, packing, r.delta_R, r.estimated_R.estimate,
                 caption(options, packing, r.calibration < 0 ? range : range + ", " + describe_estimates(r)));
  } else {
    draw_forces(output, packing, state.forces, caption(options, packing, state.description));
  }
  if (context.json) {
    nlohmann::json json{{"output", options.output}, {"format", format}, {"state", state.description}};
    if (format == "extxyz") json["bonds"] = bonds_path_of(output).string();
    std::cout << json.dump(2) << '\n';
  } else if (context.prints_report()) {
    say("written to {}{}\n", options.output,
        format == "extxyz" ? " and " + bonds_path_of(output).string() : "");
  }
  return kDone;
}

}  // namespace

Command add_export(CLI::App& root) {
  const auto options = std::make_shared<ExportOptions>();
  CLI::App* command = root.add_subcommand("export", "Draw a packing, or write it for other programs");
  command->add_option("file", options->file, "HDF5 file of a packing, with or without force ranges or limits")
      ->required()
      ->type_name("FILE.h5");
  command
      ->add_option("--format", options->format,
                   "Format of the output (default: by the extension of -o, else svg)")
      ->check(CLI::IsMember(std::vector<std::string>(kFormats.begin(), kFormats.end())));
  const auto check_state = [](const std::string& text) -> std::string {
    if (parse_state(text)) return "";
    return "must be sim, limit, max-norm, state:K, or R_min:C, R_max:C, T_min:C, T_max:C of contact C";
  };
  command
      ->add_option(
          "--state", options->state,
          "Which contact forces to show. sim: as simulated; limit: those at the limit of --limit; max-norm: "
          "the extremal state of largest norm; "
          "state:K: extremal state K of the file; R_min:C, R_max:C, T_min:C, T_max:C: the state in which "
          "that force of contact C is extremal")
      ->check(CLI::Validator(check_state, "STATE"))
      ->capture_default_str();
  command
      ->add_option(
          "--style", options->style,
          "What a picture shows. forces: the contact forces of the state; delta-R: the range of each normal "
          "force as a colour; mechanism: how the disks move at the limit of --limit, or, with force ranges, "
          "how "
          "a packing falls that cannot stand; yield-curve: the map of two loads that limit --map made; "
          "steps: "
          "how far forces can vary on the way to the limit of --limit, that limit --steps made")
      ->check(CLI::IsMember({"forces", "delta-R", "mechanism", "yield-curve", "steps"}))
      ->capture_default_str();
  const auto check_limit = [](const std::string& text) -> std::string {
    return parse_limit(text) ? "" : "must be largest or smallest, or K:largest, K:smallest of limit K";
  };
  command
      ->add_option("--limit", options->limit,
                   "Which end of which limit --state limit, --style mechanism and --style steps mean: "
                   "largest, smallest, or K:largest, K:smallest of limit K of the file, from 0 on")
      ->check(CLI::Validator(check_limit, "LIMIT"))
      ->capture_default_str();
  command->add_option(
      "-o,--output", options->output,
      "File to write (default: FILE with another extension, in the current folder). With --format csv: "
      "NAME.csv is one table of contacts, with forces in mg; any other name is a folder for a CSV scene that "
      "import reads. vtkhdf is for ParaView; extxyz is for OVITO, with the bonds in NAME.bonds.dump beside "
      "it");
  add_overwrite_option(*command, options->overwrite);
  return {command, [options](const Context& context) { return run(*options, context); }};
}

}  // namespace indet::app
