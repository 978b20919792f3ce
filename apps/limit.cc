#include "libindet/limit/limit.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "apps/analysis_arguments.h"
#include "apps/command.h"
#include "apps/limit_report.h"
#include "apps/load_arguments.h"
#include "apps/output_files.h"
#include "apps/packing_input.h"
#include "apps/say.h"
#include "libindet/base/error.h"
#include "libindet/io/limits_file.h"
#include "libindet/io/table.h"
#include "libindet/lp/glpk_problem.h"
#include "libindet/sampling/limit_walk.h"

namespace indet::app {
namespace {

struct LimitCommand {
  std::string packing;
  std::string output;
  bool overwrite = false;
  bool tilt = false;
  std::optional<double> ignore_below;  ///< degrees
  std::vector<std::string> loads;
  int map = 0;
  bool friction = false;
  std::string friction_of = "all";
  int steps = 0;
};

/// The contacts of --friction-of.
std::vector<bool> scaled_contacts(const LimitCommand& options, const Packing& packing) {
  std::vector<bool> scaled(packing.contacts.size(), options.friction_of == "all");
  if (options.friction_of == "walls" || options.friction_of == "disks") {
    for (std::size_t i = 0; i < scaled.size(); ++i)
      scaled[i] = packing.contacts[i].b.is_wall() == (options.friction_of == "walls");
  } else if (options.friction_of != "all") {
    for (const int i : parse_contact_list("--friction-of", options.friction_of, options.friction_of,
                                          packing.contact_count()))
      scaled[static_cast<std::size_t>(i)] = true;
  }
  bool any = false;
  for (std::size_t i = 0; i < scaled.size(); ++i) any = any || (scaled[i] && packing.contacts[i].mu > 0);
  if (!any)
    throw InputError(fmt::format("{}: --friction varies coefficients of friction, and all of {} are 0",
                                 options.packing, options.friction_of));
  return scaled;
}

/// Direction k of the map of two loads. Multiples of 90° are exact.
Limit find_on_map(const Packing& packing, const LimitCommand& options, const std::vector<Loads>& loads,
                  int k) {
  const double angle = 2 * std::numbers::pi * k / options.map;
  const bool is_second = 4 * k == options.map;
  const double first = is_second ? 0 : std::cos(angle);
  const double second = k == 0 ? 0 : is_second ? 1 : std::sin(angle);
  const std::string name =
      fmt::format("({:.6g}) {} + ({:.6g}) {}", first, options.loads[0], second, options.loads[1]);
  Limit limit = find_load(packing, name, combined(first, loads[0], second, loads[1]));
  limit.map_angle = angle;
  return limit;
}

/// On the way to each end that there is a way to; warns if there is none.
void find_steps(const Packing& packing, int steps, const Context& context, std::vector<Limit>& limits) {
  bool is_any = false;
  LimitWalkOptions options;
  options.threads = context.thread_count();
  options.progress = context.progress();
  for (Limit& limit : limits) {
    for (LimitEnd* end : {&limit.smallest, &limit.largest}) {
      if (!limit.has_way_to(*end)) continue;
      end->steps = walk_to_limit(packing, limit, *end, steps, options);
      is_any = true;
    }
  }
  if (!is_any)
    context.warn("--steps: no way to go, since the packing stands at its limit, at none, or without any");
}

bool has_certain_steps(const std::vector<Limit>& limits) {
  const auto is_certain = [](const LimitEnd& end) {
    return std::all_of(end.steps.begin(), end.steps.end(), [](const LimitStep& s) { return s.is_certain(); });
  };
  return std::all_of(limits.begin(), limits.end(), [&](const Limit& limit) {
    return is_certain(limit.smallest) && is_certain(limit.largest);
  });
}

int run(const LimitCommand& options, const Context& context) {
  if (!options.tilt && options.loads.empty() && !options.friction)
    throw UsageError("limit needs to know what to vary: --tilt, --load or --friction");
  if (options.map > 0 && options.loads.size() != 2)
    throw UsageError("--map needs two --load, whose plane it maps");
  if (options.friction_of != "all" && !options.friction)
    throw UsageError("--friction-of has no effect without --friction");
  if (options.ignore_below && !options.tilt)
    throw UsageError("--ignore-below has no effect without --tilt, whose angles it is about");
  if (options.steps > 0 && options.map > 0)
    throw UsageError(
        "--steps goes to the limit of each --tilt, --load and --friction, not to those of a --map");
  const Packing packing = read_packing(open_packing(options.packing));
  std::filesystem::path output = options.output;
  if (output.empty()) output = std::filesystem::path(options.packing).replace_extension(".limits.h5");
  claim_output(output, FileKind::kLimits, replacement_rule({options.packing}, options.overwrite, context));
  if (options.tilt && packing.gravity.isZero(0))
    throw InputError(fmt::format("{}: --tilt turns gravity, and there is none", options.packing));
  std::vector<Loads> changes;
  for (const std::string& text : options.loads) changes.push_back(parse_load(text, packing));
  if (options.map > 0 && are_parallel(changes[0], changes[1]))
    throw InputError("--map: one of the two loads is a multiple of the other, so that they span no plane");

  Provenance provenance;
  provenance.arguments = context.arguments;
  provenance.config = context.resolved_config;
  provenance.libraries["GLPK"] = glpk_version();
  std::vector<Limit> limits;
  const auto progress = context.progress();
  const int directions = options.map / 2;  // each has two ends
  const std::int64_t total = (directions > 0 ? directions : std::ssize(changes)) + (options.tilt ? 1 : 0) +
                             (options.friction ? 1 : 0);
  const auto add = [&](auto find) {
    if (progress && !progress({"limits", static_cast<std::int64_t>(limits.size()), total, ""}))
      throw Interrupted();
    const auto start = std::chrono::steady_clock::now();
    limits.push_back(find());
    provenance.seconds[fmt::format("limit {}", limits.size() - 1)] =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  if (options.tilt)
    add([&] { return find_tilt(packing, options.ignore_below.value_or(0) * std::numbers::pi / 180); });
  for (int k = 0; k < directions; ++k) add([&] { return find_on_map(packing, options, changes, k); });
  for (std::size_t k = 0; directions == 0 && k < changes.size(); ++k)
    add([&] { return find_load(packing, options.loads[k], changes[k]); });
  if (options.friction) {
    const std::string name =
        options.friction_of == "all" ? "friction" : fmt::format("friction of {}", options.friction_of);
    add([&] { return find_friction(packing, name, scaled_contacts(options, packing)); });
  }
  if (options.steps > 0) {
    const auto start = std::chrono::steady_clock::now();
    find_steps(packing, options.steps, context, limits);
    provenance.seconds["steps"] =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  write_limits(output, packing, limits, provenance);

  if (context.json) {
    nlohmann::json json = limits_to_json(packing, limits);
    json["file"] = output.string();
    std::cout << json.dump(2) << '\n';
  } else if (context.prints_report()) {
    say("{}: {}, {}\n", options.packing, describe_disks(packing),
        counted(packing.contact_count(), "contact"));
    print_limits(packing, limits);
    say("written: {}\n", output.string());
  }
  const auto is_decided = [](const Limit& limit) { return limit.is_decided(); };
  if (!std::all_of(limits.begin(), limits.end(), is_decided)) return kUncertain;
  if (!has_certain_steps(limits)) return kUncertain;
  const auto stands = [](const Limit& limit) { return limit.stands(); };
  return std::all_of(limits.begin(), limits.end(), stands) ? kDone : kNoAdmissibleState;
}

}  // namespace

Command add_limit(CLI::App& root) {
  CLI::App* command = root.add_subcommand("limit",
                                          "Find how far a packing can be tilted or loaded, or with how "
                                          "little friction, before no contact forces balance it");
  const auto options = std::make_shared<LimitCommand>();
  command->add_option("packing", options->packing, "HDF5 file of a packing, from simulate or import")
      ->required()
      ->type_name("P.h5");
  command->add_option("-o,--output", options->output, "File to write (default: P.limits.h5 beside P.h5)")
      ->type_name("L.h5");
  add_overwrite_option(*command, options->overwrite);
  command->add_flag("--tilt", options->tilt,
                    "By what angles gravity can be turned, both ways, while all else stays as it is");
  command
      ->add_option(
          "--ignore-below", options->ignore_below,
          "--tilt: take out, one after the other, disks that alone move at an angle below this (in "
          "degrees), if the packing stands without them; their weight goes with them, and each is named")
      ->type_name("ANGLE")
      ->check(CLI::Range(0.0, 180.0));
  command
      ->add_option("--load", options->loads,
                   "What multiple, positive or negative, of this load can act beside what acts already: "
                   "disk=ID,fx,fy[,torque], wall=NAME,normal,tangential of a loaded wall, gravity=gx,gy, "
                   "stress=xx,yy,xy, several joined by +, or the name of a TOML file; in the units of the "
                   "scene. May be given several times, for a limit each")
      ->type_name("LOAD")
      ->allow_extra_args(false);
  const auto check_map = [](const std::string& text) -> std::string {
    std::int64_t number = 0;
    const bool fits = parse_number(text, &number) && number >= 4 && number <= 3600 && number % 2 == 0;
    return fits ? "" : "must be an even number from 4 to 3600";
  };
  command
      ->add_option("--map", options->map,
                   "With two --load: the largest multiples of (cos φ) times the first and (sin φ) times the "
                   "second, in K directions φ; export --style yield-curve draws them")
      ->type_name("K")
      ->check(CLI::Validator(check_map, "K"));
  command->add_flag(
      "--friction", options->friction,
      "With how little friction it still stands: the least factor of all coefficients of friction");
  command
      ->add_option(
          "--friction-of", options->friction_of,
          "--friction: of which contacts the coefficients are multiplied: all, walls (those with walls), "
          "disks (those between disks), or a list like 3,7,12-20")
      ->type_name("all|walls|disks|LIST")
      ->capture_default_str();
  const auto check_steps = [](const std::string& text) -> std::string {
    std::int64_t number = 0;
    return parse_number(text, &number) && number >= 1 && number <= 1000 ? ""
                                                                        : "must be a number from 1 to 1000";
  };
  command
      ->add_option("--steps", options->steps,
                   "How the polytope of admissible states shrinks on the way to each limit: ranges of the "
                   "forces, sizes and sliding contacts of a uniform sample (seed 0, at least 100 effective "
                   "states) in n equal steps from the packing as it is, and just before the limit; export "
                   "--style steps draws them")
      ->type_name("n")
      ->check(CLI::Validator(check_steps, "n"));
  return {command, [options](const Context& context) { return run(*options, context); }};
}

}  // namespace indet::app
