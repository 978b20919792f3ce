#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <iostream>
#include <limits>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "apps/account_report.h"
#include "apps/command.h"
#include "apps/distance_report.h"
#include "apps/ensemble/presentation/comparison.h"
#include "apps/ensemble/tables/ensemble_file.h"
#include "apps/estimate_report.h"
#include "apps/file_contents.h"
#include "apps/kept_states.h"
#include "apps/limit_report.h"
#include "apps/packing_input.h"
#include "apps/paper_work.h"
#include "apps/ranges_json.h"
#include "apps/say.h"
#include "apps/statistics.h"
#include "apps/wording.h"
#include "libindet/io/balance.h"
#include "libindet/io/file_kind.h"
#include "libindet/io/packing_file.h"
#include "libindet/io/ranges_file.h"
#include "libindet/packing/force_bounds.h"

namespace indet::app {
namespace {

struct Extremes {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  double sum = 0;
  int count = 0;  ///< Of finite values.

  void add(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
    sum += value;
    ++count;
  }
  double mean() const { return count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN(); }
};

template <class Values>
Extremes extremes(const Values& values) {
  Extremes result;
  for (const double value : values) result.add(value);
  return result;
}

nlohmann::json to_json(const Account& account) {
  nlohmann::json json = account.texts;
  for (const auto& [name, value] : account.numbers) json[name] = json_number(value);
  return json;
}

nlohmann::json to_json(const std::string& path, const FileContents& contents) {
  const Packing& packing = contents.packing;
  nlohmann::json json = {
      {"file", path},
      {"protocol", packing.origin.protocol},
      {"seed", packing.origin.seed < 0 ? nlohmann::json() : nlohmann::json(packing.origin.seed)},
      {"disks", packing.disk_count()},
      {"fixed_disks", packing.fixed_disk_count()},
      {"walls", packing.wall_count()},
      {"contacts", packing.contact_count()},
      {"levers", packing.has_levers()},
      {"loaded_walls", packing.has_loaded_walls()},
      {"bounds", force_bounds(packing).size()},
      {"cell", cell_to_json(packing.cell)},
      {"stress", stress_to_json(packing.stress)},
      {"gravity", {packing.gravity.x(), packing.gravity.y()}},
      {"force_unit", packing.force_unit()},
      {"r_max", packing.max_radius()},
      {"Lx", packing.origin.width},
      {"Ly", packing.origin.height},
      {"forces_known", contents.balance.forces_known},
      {"known_forces", contents.balance.known_forces},
      {"checked_disks", contents.balance.checked_disks},
      {"content_sha256", contents.digests.content},
      {"intact", contents.digests.match()},
      {"provenance", contents.provenance}};
  if (contents.balance.checked_disks > 0) {
    json["force_residual"] = contents.balance.force_residual;
    json["torque_residual"] = contents.balance.torque_residual;
  }
  if (contents.balance.any_known()) {
    json["coulomb_violations"] = contents.balance.coulomb_violations;
    json["sliding"] = contents.balance.sliding;
  }
  if (contents.simulation) json["simulation"] = to_json(*contents.simulation);
  if (contents.tilt) json["tilt"] = to_json(*contents.tilt);
  if (contents.sampling) json["sampling"] = to_json(*contents.sampling);
  if (contents.trajectory) {
    json["trajectory"] = {{"frames", contents.trajectory->frames},
                          {"start", contents.trajectory->start},
                          {"end", contents.trajectory->end}};
  }
  if (!contents.limits.empty()) json.update(limits_to_json(packing, contents.limits));
  if (contents.ranges) {
    const ForceRanges& r = *contents.ranges;
    json["ranges_sha256"] = contents.digests.ranges;
    json["ranges"] = summary_to_json(r);
    json["ranges"].update({{"states", r.states.rows()},
                           {"extremal_states", to_string(r.state_kind)},
                           {"states_of", to_string(r.states_of)},
                           {"duals", r.duals.contacts.size()},
                           {"mean_delta_R", json_number(statistics(r.delta_R).mean)},
                           {"max_delta_R", json_number(statistics(r.delta_R).max)},
                           {"mean_delta_T", json_number(statistics(r.delta_T).mean)},
                           {"max_delta_T", json_number(statistics(r.delta_T).max)}});
    if (has_smallest_distances(r)) json["ranges"]["smallest_distances"] = smallest_distances_to_json(r);
    if (r.calibration >= 0) json["ranges"]["estimates"] = estimates_to_json(r);
    if (r.reactions.count() > 0) json["ranges"]["reactions"] = reactions_to_json(packing, r.reactions);
    if (r.method == Method::kPivotingPaper) json["ranges"]["paper"] = describe_paper_work(r);
  }
  return json;
}

std::string span_text(const Extremes& e, const char* unit) {
  if (e.count == 0) return "none";
  return fmt::format("{:.4g} … {:.4g}{}, mean {:.4g}", e.low, e.high, unit, e.mean());
}

/// Where the unit of force comes from.
const char* describe_unit(const Packing& packing) {
  if (packing.named_force_unit > 0) return "";
  if (packing.has_weight()) return " = mg";
  return packing.largest_load() > 0 ? ", the largest load" : "";
}

void print_packing(const FileContents& contents) {
  const Packing& packing = contents.packing;
  const double unit = packing.force_unit();
  Extremes radius;
  Extremes friction;
  Extremes force;
  for (const Disk& disk : packing.disks) radius.add(disk.radius);
  for (const Contact& contact : packing.contacts) {
    friction.add(contact.mu);
    force.add(contact.R / unit);
  }
  std::string walls = fmt::format("{}", packing.wall_count());
  for (const Wall& wall : packing.walls) {
    walls += fmt::format("{}{}", &wall == packing.walls.data() ? ": " : ", ", wall_name(wall));
    if (wall.is_free_along_normal()) walls += fmt::format(" (load_n = {:.4g} mg)", wall.load_n / unit);
    if (wall.is_free_along_tangent()) walls += fmt::format(" (load_t = {:.4g} mg)", wall.load_t / unit);
  }
  const int fixed = packing.fixed_disk_count();
  print_line("packing",
             fmt::format("{}{}", packing.origin.protocol,
                         packing.origin.seed < 0 ? "" : fmt::format(", seed {}", packing.origin.seed)));
  print_line("  disks",
             fmt::format("{}{}, radius {}", packing.disk_count(),
                         fixed > 0 ? fmt::format(" ({} fixed)", fixed) : "", span_text(radius, "")));
  print_line("  walls", walls);
  print_line("  contacts",
             fmt::format("{} ({})", packing.contact_count(), describe_expected_dimension(packing)));
  if (packing.has_levers()) print_line("  levers", describe_levers(packing));
  if (!force_bounds(packing).empty())
    print_line("  bounds", fmt::format("{} of R and T", force_bounds(packing).size()));
  if (packing.cell.is_periodic()) print_line("  periodic cell", describe_cell(packing.cell));
  if (packing.cell.is_full()) print_line("  imposed stress", describe_stress(packing.stress));
  print_line("  friction",
             friction.low == friction.high ? fmt::format("{:g}", friction.low) : span_text(friction, ""));
  if (packing.origin.width > 0 && packing.origin.height > 0) {
    print_line("  made in", fmt::format("Lx = {:g}, Ly = {:g}", packing.origin.width, packing.origin.height));
  }
  print_line("  gravity", fmt::format("({:g}, {:g}); the unit of force is {:.6g}{}", packing.gravity.x(),
                                      packing.gravity.y(), unit, describe_unit(packing)));
  const BalanceReport& balance = contents.balance;
  if (!balance.any_known()) {
    print_line("  simulated forces", "unknown");
    return;
  }
  if (!balance.forces_known) {
    print_line("  simulated forces",
               fmt::format("{} of {} known; all of them on {} of {}", balance.known_forces,
                           2 * packing.contact_count(), balance.checked_disks,
                           counted(packing.free_disk_count(), "disk")));
  }
  print_line("  simulated R", span_text(force, " mg"));
  if (balance.checked_disks > 0) {
    print_line("  balance",
               fmt::format("force to {:.1e} mg, torque to {:.1e} mg r, {}{}", balance.force_residual,
                           balance.torque_residual, counted(balance.coulomb_violations, "Coulomb violation"),
                           balance.forces_known ? "" : " (of these disks)"));
  }
  print_line("  at their limit", describe_sliding(balance.sliding, balance.non_transmitting));
}

/// Ranges of what walls and fixed disks bear, the first ones.
void print_reactions(const Packing& packing, const ForceRanges& ranges) {
  constexpr Eigen::Index kShown = 12;
  const Reactions& r = ranges.reactions;
  for (Eigen::Index k = 0; k < std::min(kShown, r.count()); ++k) {
    const Body body = Body::from_code(r.body[k]);
    const std::string name = body.is_wall() ? "wall " + wall_name(packing[body.wall_id()])
                                            : fmt::format("disk {}", packing[body.disk_id()].id);
    const bool is_torque = !body.is_wall() && r.component[k] == 2;
    const double unit = ranges.force_unit * (is_torque ? packing[body.disk_id()].radius : 1);
    print_line(k == 0 ? "  reactions (mg)" : "",
               fmt::format("{}, {}{}: {:.4g} … {:.4g}", name, reaction_component(body, r.component[k]),
                           is_torque ? "/r" : "", r.value(k, 0) / unit, r.value(k, 1) / unit));
  }
  if (r.count() > kShown) print_line("", fmt::format("… and {} more sums", r.count() - kShown));
}

std::string describe_choice(const ForceRanges& r) {
  switch (r.choice) {
    case ContactChoice::Kind::kSample:
      return fmt::format("a sample, seed {}", r.sample_seed);
    case ContactChoice::Kind::kCalibration:
      return "for the calibration of estimates";
    default:
      return "a list";
  }
}

void print_ranges(const ForceRanges& r) {
  const auto measure = [](const Eigen::VectorXd& values) {
    const auto infinite = std::count_if(values.begin(), values.end(), [](double v) { return std::isinf(v); });
    return span_text(extremes(values), "") + (infinite > 0 ? fmt::format("; {} unbounded", infinite) : "");
  };
  print_line("force ranges", to_string(r.status));
  print_line("  equilibrium",
             fmt::format("{} unknown forces, {} equations, rank {}{}, nullity {}, dimension {}", r.unknowns,
                         r.equations, r.rank, r.rank_ambiguous ? " (ambiguous)" : "", r.nullity, r.dim));
  if (r.choice != ContactChoice::Kind::kAll) {
    print_line("  asked for",
               fmt::format("{} of {} contacts ({})", r.requested, r.outcome.rows(), describe_choice(r)));
  }
  print_line("  extrema",
             fmt::format("{}: {} certified{}, {} imprecise, {} failed", r.objectives, r.certified,
                         r.unbounded > 0 ? fmt::format(" ({} of them unbounded)", r.unbounded) : "",
                         r.imprecise, r.failed));
  print_line("  residuals", fmt::format("{:.1e} of balance and friction, {:.1e} of optimality",
                                        r.worst_primal_residual, r.worst_dual_residual));
  print_line("  δR (mg)", measure(r.delta_R));
  print_line("  δT (mg)", measure(r.delta_T));
  if (r.calibration >= 0) {
    print_line("  δR, estimated", measure(r.estimated_R.estimate));
    print_line("  δT, estimated", measure(r.estimated_T.estimate));
  }
  if (r.states.rows() > 0) {
    print_line("  dR (mg)", measure(r.d_R));
    print_line("  dT (mg)", measure(r.d_T));
  }
  if (has_smallest_distances(r)) {
    print_line("  dR_min (mg)", measure(r.smallest.d_R));
    print_line("  dT_min (mg)", measure(r.smallest.d_T));
    print_line("", describe_smallest_distances(r));
  }
  if (r.status != PolytopeStatus::kEmpty) print_line("  extremal states", describe_kept_states(r));
  if (r.duals.are_kept()) print_line("  duals", describe_duals(r.duals));
  print_line("  found by", fmt::format("{}: {}, {}", describe_method(r),
                                       counted(r.solves, "search", "searches"), counted(r.pivots, "pivot")));
}

int inspect_ensemble(const Hdf5File& file, const Context& context) {
  const std::string path = file.path().string();
  const EnsembleContents contents = read_ensemble(file);
  const Digests digests = compute_digests(file);
  const FlatTable& runs = contents.tables.runs;
  std::map<std::string, int> protocols;
  for (std::size_t row = 0; row < runs.rows(); ++row) ++protocols[runs.text("protocol", row)];
  const std::vector<Comparison> facts = beyond_the_paper(contents.tables);
  if (context.json) {
    nlohmann::json json = {{"file", path},
                           {"packings", runs.rows()},
                           {"contacts", contents.tables.contacts.rows()},
                           {"protocols", protocols},
                           {"missing", contents.missing},
                           {"content_sha256", digests.content},
                           {"intact", digests.match()}};
    for (const Comparison& fact : facts) json["facts"][fact.quantity] = fact.ours;
    std::cout << json.dump(2) << '\n';
    return kDone;
  }
  if (!digests.match()) context.warn(path + ": its numbers or texts are not those that were written");
  if (context.quiet) return kDone;
  print_line("ensemble", path);
  for (const auto& [protocol, count] : protocols) print_line("  " + protocol, counted(count, "packing"));
  print_line("  contacts", fmt::format("{}", contents.tables.contacts.rows()));
  print_line("  missing packings", fmt::format("{}", contents.missing.size()));
  for (const Comparison& fact : facts) say("  {:<30}{}\n", fact.quantity, fact.ours);
  print_line("contents", digests.content + (digests.match() ? "" : " DIFFERS"));
  return kDone;
}

int run(const std::string& given, const Context& context) {
  const std::string in_folder = (std::filesystem::path(given) / "ensemble.h5").string();
  std::error_code ignored;
  const std::string path = std::filesystem::exists(in_folder, ignored) ? in_folder : given;
  const Hdf5File file = open_packing_or_ensemble(path);
  if (kind_of(file) == FileKind::kEnsemble) return inspect_ensemble(file, context);
  const FileContents contents = read_contents(file);
  if (context.json) {
    std::cout << to_json(path, contents).dump(2) << '\n';
    return kDone;
  }
  if (!contents.digests.match())
    context.warn(path + ": its numbers or texts are not those that were written");
  if (context.quiet) return kDone;
  print_line("file", path);
  print_packing(contents);
  if (contents.simulation) print_simulation(*contents.simulation);
  if (contents.tilt) print_tilt(*contents.tilt);
  if (contents.trajectory) {
    print_line("trajectory",
               fmt::format("{}, time {:.4g} … {:.4g}",
                           counted(static_cast<std::int64_t>(contents.trajectory->frames), "frame"),
                           contents.trajectory->start, contents.trajectory->end));
  }
  if (contents.sampling) print_sampling(*contents.sampling);
  if (!contents.limits.empty()) print_limits(contents.packing, contents.limits);
  if (contents.ranges) {
    print_ranges(*contents.ranges);
    print_reactions(contents.packing, *contents.ranges);
    print_line("  SHA-256", contents.digests.ranges);
  } else {
    if (contents.limits.empty()) print_line("force ranges", "none yet: indet analyze " + path);
  }
  print_line("written", fmt::format("{} on {} by indet {} ({}, {})", contents.provenance.at("created"),
                                    contents.provenance.at("host"), contents.provenance.at("version"),
                                    contents.provenance.at("git"), contents.provenance.at("compiler")));
  print_line("contents", contents.digests.content + (contents.digests.match() ? "" : " DIFFERS"));
  return kDone;
}

}  // namespace

Command add_inspect(CLI::App& root) {
  const auto path = std::make_shared<std::string>();
  CLI::App* command = root.add_subcommand("inspect", "Show what is in a file, on one screen");
  command->add_option("file", *path, "HDF5 file of a packing or an ensemble, or the folder of an ensemble")
      ->required();
  return {command, [path](const Context& context) { return run(*path, context); }};
}

}  // namespace indet::app
