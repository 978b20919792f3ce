#include <fmt/format.h>

#include <cmath>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/command.h"
#include "apps/configuration.h"
#include "apps/import_arguments.h"
#include "apps/output_files.h"
#include "apps/say.h"
#include "apps/wording.h"
#include "libindet/base/error.h"
#include "libindet/base/tolerances.h"
#include "libindet/io/balance.h"
#include "libindet/io/lever_search.h"
#include "libindet/io/packing_file.h"
#include "libindet/packing/force_bounds.h"

namespace indet::app {
namespace {

nlohmann::json to_json(const ImportedPacking& imported, const BalanceReport& report,
                       const StressReport& stress, double tolerance, const std::string& output) {
  const Packing& packing = imported.packing;
  nlohmann::json json = {{"output", output},
                         {"disks", packing.disk_count()},
                         {"fixed_disks", packing.fixed_disk_count()},
                         {"walls", packing.wall_count()},
                         {"contacts", packing.contact_count()},
                         {"gravity", {packing.gravity.x(), packing.gravity.y()}},
                         {"force_unit", packing.force_unit()},
                         {"forces_known", report.forces_known},
                         {"known_forces", report.known_forces},
                         {"checked_disks", report.checked_disks},
                         {"duplicates", report.duplicates},
                         {"levers", packing.has_levers()},
                         {"loaded_walls", packing.has_loaded_walls()},
                         {"bounds", force_bounds(packing).size()},
                         {"cell", cell_to_json(packing.cell)},
                         {"stress", stress_to_json(packing.stress)},
                         {"without_equations", imported.without_equations},
                         {"loose_disks", report.loose_disks},
                         {"balance_tolerance", tolerance},
                         {"warnings", imported.warnings}};
  if (stress.of_forces) {
    const Eigen::Matrix2d& s = *stress.of_forces;
    json["stress_of_forces"] = {{s(0, 0), s(0, 1)}, {s(1, 0), s(1, 1)}};
  }
  if (imported.levers) {
    json["lever_choice"] = {{"levers", name_of(imported.levers->levers)},
                            {"tried", nlohmann::json::object()}};
    for (const LeverTrial& trial : imported.levers->trials) {
      json["lever_choice"]["tried"][name_of(trial.levers)] = trial.residual;
    }
  }
  if (report.checked_disks > 0) {
    json["force_residual"] = report.force_residual;
    json["torque_residual"] = report.torque_residual;
    if (packing.stress.is_imposed()) json["stress_residual"] = report.stress_residual;
    if (packing.has_loaded_walls()) json["wall_residual"] = report.wall_residual;
  }
  if (report.any_known()) {
    json["coulomb_violations"] = report.coulomb_violations;
    json["worst_violation"] = report.worst_violation;
    json["sliding"] = report.sliding;
    json["non_transmitting"] = report.non_transmitting;
  }
  return json;
}

/// "131 of 262 forces known; their balance was checked on 12 of 50 disks, which have all of them".
std::string describe_knowledge(const Packing& packing, const BalanceReport& report) {
  if (!report.any_known()) return "the forces are unknown, so their balance was not checked";
  const std::string known =
      fmt::format("{} of {} forces known; ", report.known_forces, 2 * packing.contact_count());
  if (report.checked_disks == 0) return known + "no disk has all of them, so their balance was not checked";
  return known + fmt::format("their balance was checked on {} of {}, which have all of them",
                             report.checked_disks, counted(packing.free_disk_count(), "disk"));
}

/// Which lever arms were taken, and how the torques balance with each choice.
void print_levers(const LeverChoice& choice) {
  const char* why = "";
  switch (choice.reason) {
    case LeverChoice::Reason::kGiven:
      why = "as given";
      break;
    case LeverChoice::Reason::kBest:
      why = "which balances best";
      break;
    case LeverChoice::Reason::kDocumented:
      why = "the usual one, which balances";
      break;
    case LeverChoice::Reason::kNone:
      why = "the usual one; none balances";
      break;
    case LeverChoice::Reason::kUnknown:
      why = "the usual one";
      break;
  }
  say("lever arms          {} ({})\n", name_of(choice.levers), why);
  if (choice.trials.size() < 2) return;
  for (const LeverTrial& trial : choice.trials) {
    say("{:20}{:37}{:.2e} mg r\n", "", name_of(trial.levers), trial.residual);
  }
}

/// The stress that the forces make, and what is imposed.
void print_stress(const Packing& packing, const StressReport& report) {
  if (report.of_forces) {
    const Eigen::Matrix2d& s = *report.of_forces;
    say("stress of forces    xx = {:.6g}, yy = {:.6g}, xy = {:.6g}\n", s(0, 0), s(1, 1), s(0, 1));
    // Torques that do not act at the ends of the branch vectors leave this.
    const double asymmetry = s(0, 1) - s(1, 0);
    if (std::abs(asymmetry) > tolerance::kSymmetricStress * s.norm())
      say("                    xy − yx = {:.3g}\n", asymmetry);
  }
  if (!packing.cell.is_full()) return;
  say("imposed stress      {}{}\n", describe_stress(packing.stress),
      report.is_taken_from_forces ? " (that of the forces)" : "");
}

void print_report(const ImportedPacking& imported, const BalanceReport& report, const StressReport& stress,
                  double tolerance) {
  const Packing& packing = imported.packing;
  say("{}, {}, {}, gravity ({:g}, {:g}), mg = {:.6g}\n", describe_disks(packing),
      counted(packing.wall_count(), "wall"), counted(packing.contact_count(), "contact"), packing.gravity.x(),
      packing.gravity.y(), packing.force_unit());
  if (!report.forces_known) say("{}\n", describe_knowledge(packing, report));
  if (report.checked_disks > 0) {
    // Where nothing is left over there is no worst disk.
    const auto name = [&](DiskId disk) {
      return disk.value() < 0 ? "" : fmt::format(" (disk {})", packing[disk].id);
    };
    say("largest net force   {:.2e} mg{}\n", report.force_residual, name(report.worst_force));
    say("largest net torque  {:.2e} mg r{}\n", report.torque_residual, name(report.worst_torque));
    if (packing.has_loaded_walls()) {
      say("net force on a wall {:.2e} mg{}\n", report.wall_residual,
          report.worst_wall.value() < 0 ? ""
                                        : fmt::format(" (wall {})", wall_name(packing[report.worst_wall])));
    }
    if (packing.stress.is_imposed() && report.forces_known && !stress.is_taken_from_forces)
      say("stress off by       {:.2e} mg on a side of the cell\n", report.stress_residual);
    say("                    (accepted up to {:.0e})\n", tolerance);
    if (imported.levers) print_levers(*imported.levers);
  }
  if (packing.cell.is_periodic()) {
    say("periodic cell       {}\n", describe_cell(packing.cell));
    print_stress(packing, stress);
  }
  if (report.any_known()) {
    say("Coulomb violations  {}", report.coulomb_violations);
    if (report.coulomb_violations > 0) say(", the worst by {:.2e} mg", report.worst_violation);
    say("\nsliding contacts    {}\n", report.sliding - 2 * report.non_transmitting);
    say("without force       {}\n", report.non_transmitting);
  }
  if (packing.has_levers() && !imported.levers) say("levers              {}\n", describe_levers(packing));
  if (!force_bounds(packing).empty()) say("bounds of forces    {}\n", force_bounds(packing).size());
  say("listed twice        {}\n", report.duplicates);
  if (imported.without_equations > 0)
    say("left out            {} between two bodies that do not move\n",
        counted(imported.without_equations, "contact"));
  say("loose disks         {}", report.loose_disks);
  if (report.loose_disks > 0) say(", the first is disk {}", packing[report.first_loose].id);
  say("\n");
}

int run(const ImportArguments& options, const CLI::App& command, const Context& context) {
  const ImportOrder order = import_order(options, command);
  claim_output(options.output, FileKind::kPacking,
               replacement_rule(order.format->files(order.request), options.overwrite, context));
  ImportedPacking imported = order.format->read(order.request);
  imported.packing.origin.config = resolved_configuration(command);
  const StressReport stress = impose_stress(
      imported, order.stress,
      fmt::format("{}: --stress", options.input.empty() ? options.dumps.atoms.string() : options.input));
  const double tolerance = options.balance_tolerance.value_or(default_balance_tolerance(imported));
  choose_levers(imported, order.levers, order.format->documented, tolerance);
  if (!imported.levers && (order.levers.pair || order.levers.wall)) {
    throw InputError(
        fmt::format("{}: the contacts have levers of their own, so --lever cannot be given", options.input));
  }
  warn_of_idle_friction(imported);
  const BalanceReport report = report_balance(imported);
  for (const std::string& warning : imported.warnings) context.warn(warning);
  if (report.coulomb_violations > 0) {
    context.warn(fmt::format(
        "{} of {} violate the Coulomb conditions (R ≥ 0, |T| ≤ μR), the worst by {:.2e} mg; is the "
        "friction coefficient that of the simulation?",
        report.coulomb_violations, counted(imported.packing.contact_count(), "contact"),
        report.worst_violation));
  }
  require_balance(imported, report, tolerance);
  if (report.stress_residual > tolerance) {
    context.warn(fmt::format(
        "the known forces do not make the stress that is imposed: {:.2e} mg are missing across a side of the "
        "cell, so that they do not lie in the ranges",
        report.stress_residual));
  }
  write_packing(options.output, imported.packing, {context.arguments, context.resolved_config, {}, {}});
  if (context.json) {
    std::cout << to_json(imported, report, stress, tolerance, options.output).dump(2) << '\n';
  } else if (context.prints_report()) {
    print_report(imported, report, stress, tolerance);
    say("written to {}\n", options.output);
  }
  return kDone;
}

}  // namespace

Command add_import(CLI::App& root) {
  const auto arguments = std::make_shared<ImportArguments>();
  CLI::App* command = root.add_subcommand("import", "Read a packing that another program made");
  add_import_options(*command, *arguments);
  return {command,
          [arguments, command](const Context& context) { return run(*arguments, *command, context); }};
}

}  // namespace indet::app
