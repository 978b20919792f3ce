#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/command.h"
#include "apps/configuration.h"
#include "apps/output_files.h"
#include "apps/wording.h"
#include "libindet/io/balance.h"
#include "libindet/io/csv_reader.h"
#include "libindet/io/csv_writer.h"
#include "libindet/io/lammps_reader.h"
#include "libindet/io/packing_file.h"

namespace indet::app {
namespace {

struct ImportOptions {
  std::string format;
  std::string folder;
  LammpsOptions lammps;
  std::vector<double> gravity = {0, -1};
  std::vector<std::string> columns;
  std::optional<double> friction;
  std::optional<double> balance_tolerance;
  std::string output;
  bool overwrite = false;
};

/// "key=name" items as a map.
std::map<std::string, std::string> parse_columns(const std::vector<std::string>& items) {
  std::map<std::string, std::string> columns;
  for (const std::string& item : items) {
    const std::size_t equals = item.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == item.size()) {
      throw UsageError(fmt::format("--columns: \"{}\" must have the form NAME=COLUMN", item));
    }
    if (!columns.emplace(item.substr(0, equals), item.substr(equals + 1)).second) {
      throw UsageError(fmt::format("--columns: {} is given twice", item.substr(0, equals)));
    }
  }
  return columns;
}

/// Options that are missing or do not fit together. (Not the parser's work: they may come from --config,
/// after the first pass over the command line.)
void check_usage(ImportOptions& options, const CLI::App& command) {
  const auto fail = [](const std::string& reason) { throw UsageError(reason); };
  if (options.format.empty()) fail("--format is required: csv or lammps");
  if (options.output.empty()) fail("-o is required: the HDF5 file to write");
  if (options.format == "csv") {
    for (const char* name : {"--atoms", "--contacts", "--timestep", "--friction", "--gravity", "--columns"}) {
      if (command.count(name) == 0) continue;
      fail(fmt::format("{} is for --format lammps; a CSV scene has it in its files", name));
    }
    if (options.folder.empty())
      fail("--format csv needs the folder of the scene: indet import --format csv FOLDER");
    return;
  }
  if (!options.folder.empty()) {
    fail(fmt::format("--format lammps reads the files of --atoms and --contacts, and no folder ({})",
                     options.folder));
  }
  if (options.lammps.atoms.empty() || options.lammps.contacts.empty()) {
    fail("--format lammps needs two dumps: --atoms FILE --contacts FILE");
  }
  if (!options.friction)
    fail("a LAMMPS dump does not contain the friction coefficient: give it with --friction MU");
  options.lammps.friction = *options.friction;
  options.lammps.gravity = {options.gravity[0], options.gravity[1]};
  options.lammps.columns = parse_columns(options.columns);
}

/// The files that are read.
std::vector<std::filesystem::path> inputs_of(const ImportOptions& options) {
  if (options.format == "lammps") return {options.lammps.atoms, options.lammps.contacts};
  std::vector<std::filesystem::path> inputs;
  for (const char* name : kSceneFiles) inputs.push_back(std::filesystem::path(options.folder) / name);
  return inputs;
}

nlohmann::json to_json(const ImportedPacking& imported, const BalanceReport& report, double tolerance,
                       const std::string& output) {
  const Packing& packing = imported.packing;
  nlohmann::json json = {{"output", output},
                         {"disks", packing.disk_count()},
                         {"fixed_disks", packing.disk_count() - packing.free_disk_count()},
                         {"walls", packing.wall_count()},
                         {"contacts", packing.contact_count()},
                         {"gravity", {packing.gravity.x(), packing.gravity.y()}},
                         {"force_unit", packing.force_unit()},
                         {"forces_known", report.forces_known},
                         {"known_forces", report.known_forces},
                         {"checked_disks", report.checked_disks},
                         {"duplicates", report.duplicates},
                         {"levers", packing.has_levers()},
                         {"without_equations", imported.without_equations},
                         {"loose_disks", report.loose_disks},
                         {"balance_tolerance", tolerance},
                         {"warnings", imported.warnings}};
  if (report.checked_disks > 0) {
    json["force_residual"] = report.force_residual;
    json["torque_residual"] = report.torque_residual;
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

void print_report(const ImportedPacking& imported, const BalanceReport& report, double tolerance) {
  const Packing& packing = imported.packing;
  fmt::print("{}, {}, {}, gravity ({:g}, {:g}), mg = {:.6g}\n", describe_disks(packing),
             counted(packing.wall_count(), "wall"), counted(packing.contact_count(), "contact"),
             packing.gravity.x(), packing.gravity.y(), packing.force_unit());
  if (!report.forces_known) fmt::print("{}\n", describe_knowledge(packing, report));
  if (report.checked_disks > 0) {
    // Where nothing is left over there is no worst disk.
    const auto name = [&](DiskId disk) {
      return disk.value() < 0 ? "" : fmt::format(" (disk {})", packing[disk].id);
    };
    fmt::print("largest net force   {:.2e} mg{}\n", report.force_residual, name(report.worst_force));
    fmt::print("largest net torque  {:.2e} mg r{}\n", report.torque_residual, name(report.worst_torque));
    fmt::print("                    (accepted up to {:.0e})\n", tolerance);
  }
  if (report.any_known()) {
    fmt::print("Coulomb violations  {}", report.coulomb_violations);
    if (report.coulomb_violations > 0) fmt::print(", the worst by {:.2e} mg", report.worst_violation);
    fmt::print("\nsliding contacts    {}\n", report.sliding - 2 * report.non_transmitting);
    fmt::print("without force       {}\n", report.non_transmitting);
  }
  if (packing.has_levers()) fmt::print("levers              {}\n", describe_levers(packing));
  fmt::print("listed twice        {}\n", report.duplicates);
  if (imported.without_equations > 0)
    fmt::print("left out            {} between two bodies that do not move\n",
               counted(imported.without_equations, "contact"));
  fmt::print("loose disks         {}", report.loose_disks);
  if (report.loose_disks > 0) fmt::print(", the first is disk {}", packing[report.first_loose].id);
  fmt::print("\n");
}

int run(ImportOptions& options, const CLI::App& command, const Context& context) {
  check_usage(options, command);
  claim_output(options.output, FileKind::kPacking,
               replacement_rule(inputs_of(options), options.overwrite, context));
  ImportedPacking imported =
      options.format == "csv" ? read_csv_scene(options.folder) : read_lammps(options.lammps);
  imported.packing.origin.config = context.resolved_config;
  const BalanceReport report = report_balance(imported);
  const double tolerance = options.balance_tolerance.value_or(default_balance_tolerance(imported));
  for (const std::string& warning : imported.warnings) context.warn(warning);
  if (report.coulomb_violations > 0) {
    context.warn(fmt::format(
        "{} of {} violate the Coulomb conditions (R ≥ 0, |T| ≤ μR), the worst by {:.2e} mg; is the "
        "friction coefficient that of the simulation?",
        report.coulomb_violations, counted(imported.packing.contact_count(), "contact"),
        report.worst_violation));
  }
  require_balance(imported, report, tolerance);
  write_packing(options.output, imported.packing, {context.arguments, context.resolved_config, {}, {}});
  if (context.json) {
    std::cout << to_json(imported, report, tolerance, options.output).dump(2) << '\n';
  } else if (context.prints_report()) {
    print_report(imported, report, tolerance);
    fmt::print("written to {}\n", options.output);
  }
  return kDone;
}

}  // namespace

Command add_import(CLI::App& root) {
  const auto options = std::make_shared<ImportOptions>();
  CLI::App* command = root.add_subcommand("import", "Read a packing that another program made");
  command->add_option("--format", options->format, "Format of the input (required)")
      ->check(CLI::IsMember({"csv", "lammps"}));
  command->add_option("folder", options->folder,
                      "csv: the folder with disks.csv, contacts.csv, walls.csv, scene.toml");
  command->add_option("--atoms", options->lammps.atoms, "lammps: the dump of atoms (dump custom)");
  command->add_option("--contacts", options->lammps.contacts, "lammps: the dump of contacts (dump local)");
  command->add_option("--timestep", options->lammps.timestep,
                      "lammps: timestep of the frame to read (default: the last)");
  command->add_option("--friction", options->friction, "lammps: friction coefficient of all contacts")
      ->check(not_negative());
  command->add_option("--gravity", options->gravity, "lammps: acceleration of gravity x,y (default: 0,-1)")
      ->delimiter(',')
      ->expected(2);
  command
      ->add_option(
          "--columns", options->columns,
          "lammps: columns that have other names in the dumps, as NAME=COLUMN,… with NAME one of id, x, "
          "y, radius, mass, vx, vy, omegaz, atom1, atom2, fx, fy, p1, p2, wall:NAME (docs/importing.md)")
      ->delimiter(',');
  command
      ->add_option("--balance-tol", options->balance_tolerance,
                   "Largest net force (mg) or torque (mg r) on a disk that is accepted as balanced (default: "
                   "1e-6, of about the largest load on a disk if the scene names a unit far from it; more if "
                   "the files have few digits)")
      ->check(not_negative());
  command->add_option("-o,--output", options->output, "HDF5 file to write (required)");
  add_overwrite_option(*command, options->overwrite);
  return {command, [options, command](const Context& context) { return run(*options, *command, context); }};
}

}  // namespace indet::app
