#include "apps/import_arguments.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "apps/command.h"
#include "apps/numbers.h"
#include "apps/output_files.h"
#include "libindet/base/error.h"
#include "libindet/base/printable.h"
#include "libindet/io/given_walls.h"

namespace indet::app {
namespace {

[[noreturn]] void fail(const std::string& reason) { throw UsageError(reason); }

std::vector<std::string> format_names() {
  std::vector<std::string> names;
  for (const ImportFormat& format : import_formats()) names.push_back(format.name);
  return names;
}

/// "key=name" items as a map.
std::map<std::string, std::string> parse_columns(const std::vector<std::string>& items) {
  std::map<std::string, std::string> columns;
  for (const std::string& item : items) {
    const std::size_t equals = item.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == item.size()) {
      fail(fmt::format("--columns: \"{}\" must have the form NAME=COLUMN", excerpt(item)));
    }
    if (!columns.emplace(item.substr(0, equals), item.substr(equals + 1)).second) {
      fail(fmt::format("--columns: {} is given twice", item.substr(0, equals)));
    }
  }
  return columns;
}

/// What the library refuses in an option is wrong usage.
template <class Parse>
auto parsed(const char* option, const Parse& parse) {
  try {
    return parse();
  } catch (const InputError& error) {
    throw UsageError(fmt::format("{}: {}", option, error.what()));
  }
}

bool takes(const ImportFormat& format, const std::string& option) {
  return std::find(format.options.begin(), format.options.end(), option) != format.options.end();
}

/// An empty value, as of a variable of the shell that is not set, would be the same as no option.
void check_values(const ImportArguments& arguments, const CLI::App& command) {
  for (const auto& [option, has_value] : {std::pair("--timestep", arguments.dumps.timestep.has_value()),
                                          std::pair("--time", arguments.time.has_value())}) {
    if (command.count(option) > 0 && !has_value) fail(fmt::format("{}: the value is empty", option));
  }
}

/// Every option that is given must be one that the format takes.
void check_options(const ImportFormat& format, const CLI::App& command) {
  std::set<std::string> options;
  for (const ImportFormat& other : import_formats())
    options.insert(other.options.begin(), other.options.end());
  for (const std::string& option : options) {
    if (command.count(option) == 0 || takes(format, option)) continue;
    std::vector<std::string> others;
    for (const ImportFormat& other : import_formats()) {
      if (takes(other, option)) others.push_back(other.name);
    }
    fail(fmt::format("{} is for --format {}{}", option, fmt::join(others, ", "),
                     format.name == "csv" ? "; a CSV scene has it in its files" : ""));
  }
}

/// The input must be what the format reads.
void check_input(const ImportFormat& format, const ImportArguments& arguments) {
  if (format.input.empty()) {
    if (!arguments.input.empty()) {
      fail(fmt::format("--format {} reads the files of --atoms and --contacts, and no other ({})",
                       format.name, arguments.input));
    }
    if (arguments.dumps.atoms.empty() || arguments.dumps.contacts.empty()) {
      fail(fmt::format("--format {} needs two dumps: --atoms FILE --contacts FILE", format.name));
    }
  } else if (arguments.input.empty()) {
    fail(fmt::format("--format {0} needs {1}: indet import --format {0} INPUT", format.name, format.input));
  }
}

}  // namespace

void add_import_options(CLI::App& command, ImportArguments& arguments) {
  const std::vector<std::string> names = format_names();
  command.add_option("--format", arguments.format, "Format of the input (required)")
      ->check(CLI::IsMember(names));
  std::string inputs;
  for (const ImportFormat& format : import_formats()) {
    if (!format.input.empty())
      inputs += fmt::format("{}{}: {}", inputs.empty() ? "" : "; ", format.name, format.input);
  }
  command.add_option("input", arguments.input, inputs);
  command.add_option("--atoms", arguments.dumps.atoms, "lammps, liggghts: the dump of atoms (dump custom)");
  command.add_option("--contacts", arguments.dumps.contacts,
                     "lammps, liggghts: the dump of contacts (dump local)");
  command.add_option("--timestep", arguments.dumps.timestep,
                     "lammps, liggghts: timestep of the frame to read (default: the last)");
  command
      .add_option(
          "--friction", arguments.friction,
          "Friction coefficient of all contacts, or of some: disk=0.4,wall=0,wall:NAME=0.2,type:1-2=0.3; "
          "what says most decides (not csv)")
      ->delimiter(',');
  command
      .add_option(
          "--lever", arguments.lever,
          "Arm of tangential forces: radius or mid-overlap (r − δ/2), or pair=…,wall=… (default: that with "
          "which the torques balance)")
      ->delimiter(',');
  command
      .add_option(
          "--fixed", arguments.fixed,
          "Disks that are glued or frozen, and have no equations: type=2, ids as 17 or 29-34, several with "
          "commas (not csv)")
      ->delimiter(',');
  command
      .add_option("--gravity", arguments.gravity,
                  "Acceleration of gravity in the plane (default: that of the files, else 0,-1, or 0,0 in a "
                  "box that is periodic in "
                  "both directions; not csv)")
      ->delimiter(',')
      ->expected(2);
  command
      .add_option(
          "--force-unit", arguments.force_unit,
          "Unit of printed forces; needed without gravity (default: the mean weight of a disk; not csv)")
      ->check(positive());
  command
      .add_option(
          "--stress", arguments.stress,
          "Stress on a cell that is periodic in both directions, in force per length, compression positive: "
          "xx=…,yy=…,xy=… (any of them), pressure=…, or none (default: that of the files, else that of the "
          "known forces)")
      ->delimiter(',');
  command.add_option("--plane", arguments.plane, "Plane of the disks: xy or xz (default: xy; not csv)")
      ->check(CLI::IsMember({"xy", "xz"}));
  command
      .add_option("--columns", arguments.columns,
                  "lammps, liggghts: columns that have other names in the dumps, as NAME=COLUMN,… with NAME "
                  "one of id, type, "
                  "x, y, radius, diameter, mass, vx, vy, omegaz, atom1, atom2, fx, fy, p1, p2, mu, wall:NAME "
                  "(docs/importing.md)")
      ->delimiter(',');
  command
      .add_option(
          "--walls", arguments.walls,
          "liggghts: where the primitive walls of the fixes lie, as NAME=x:0,NAME=y:0.1,…; mercurydpm "
          "(.data): the exact planes of walls, where they should not follow from the contacts")
      ->delimiter(',');
  command
      .add_option(
          "--density", arguments.density,
          "mercurydpm (.data): density of the particles, sphere=D (per volume) or disk=D (per area), or "
          "by species: sphere:0=D,sphere:1=D")
      ->delimiter(',');
  command.add_option(
      "--time", arguments.time,
      "mercurydpm (.data): time of the frame to read (default: the last that both files have)");
  command
      .add_option("--balance-tol", arguments.balance_tolerance,
                  "Largest net force (mg) or torque (mg r) on a disk that is accepted as balanced (default: "
                  "1e-6, of about the largest load on a disk if the scene names a unit far from it; more if "
                  "the files have few digits)")
      ->check(not_negative());
  command.add_option("-o,--output", arguments.output, "HDF5 file to write (required)");
  add_overwrite_option(command, arguments.overwrite);
}

ImportOrder import_order(const ImportArguments& arguments, const CLI::App& command) {
  if (arguments.format.empty()) {
    fail(fmt::format("--format is required: {}", fmt::join(format_names(), ", ")));
  }
  if (arguments.output.empty()) fail("-o is required: the HDF5 file to write");
  ImportOrder order;
  for (const ImportFormat& format : import_formats()) {
    if (format.name == arguments.format) order.format = &format;
  }
  check_options(*order.format, command);
  check_values(arguments, command);
  check_input(*order.format, arguments);
  ImportSettings& settings = order.request.settings;
  order.request.input = arguments.input;
  order.request.dumps = arguments.dumps;
  settings.friction = parsed("--friction", [&] { return FrictionRule::parse(arguments.friction); });
  settings.fixed = parsed("--fixed", [&] { return FixedRule::parse(arguments.fixed); });
  order.request.walls = arguments.walls;
  order.levers = parsed("--lever", [&] { return LeverRule::parse(arguments.lever); });
  order.stress = parsed("--stress", [&] { return StressRule::parse(arguments.stress); });
  settings.density = parsed("--density", [&] { return DensityRule::parse(arguments.density); });
  order.request.time = arguments.time;
  settings.columns = parse_columns(arguments.columns);
  settings.plane = arguments.plane == "xz" ? Plane::xz() : Plane::xy();
  settings.force_unit = arguments.force_unit;
  parsed("--walls", [&] { return parse_walls(arguments.walls, settings.plane); });
  if (command.count("--gravity") > 0) settings.gravity = Vector2(arguments.gravity[0], arguments.gravity[1]);
  if (!order.format->lacks_friction.empty() && settings.friction.empty() &&
      !settings.columns.contains("mu")) {
    fail(order.format->lacks_friction + ": give it with --friction MU");
  }
  return order;
}

}  // namespace indet::app
