#include "apps/ensemble/units/plan.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "apps/bridge/simulation_values.h"
#include "libindet/base/error.h"
#include "libindet/base/version.h"
#include "libindet/io/packing_file.h"
#include "libindet/io/sha256.h"
#include "libindet/io/whole_file.h"
#include "libsim/scene_toml.h"

namespace indet {
namespace {

std::string digest(const std::string& text) {
  Sha256 sha;
  sha.update(text.data(), text.size());
  return sha.hex();
}

/// What is done with every packing.
std::string analysis_toml(const EnsembleConfig& config, std::int64_t seed) {
  std::string text =
      fmt::format("[analysis]\nstates = \"canonical\"\nsolver_states = {}\n", config.solver_states);
  const sim::PerturbOptions& s = config.sampling;
  text += fmt::format("[sampling]\nsamples = {}\n", s.samples);
  if (s.samples > 0) {
    text += fmt::format("width = {}\nchains = {}\ndistance = {}\ntolerance = {}\nsweeps = {}\n", s.width,
                        s.chains, s.distance, s.solver.tolerance, s.solver.max_sweeps);
    if (seed >= 0) text += fmt::format("seed = {}\n", seed);
  }
  return text;
}

/// Added for the packings that are sampled uniformly: the hashes of the others do not know of it.
std::string uniform_toml(const UniformOptions& u, std::int64_t seed) {
  std::string text = fmt::format("[uniform]\neffective = {}\nlargest_rhat = {}\nchains = {}\nlimit = {}\n",
                                 u.effective, u.largest_rhat, u.chains, u.limit);
  if (seed >= 0) text += fmt::format("seed = {}\n", seed);
  return text;
}

void add_uniform_sampling(const EnsembleConfig& config, double disks, Unit& unit) {
  unit.uniform = true;
  unit.config += uniform_toml(config.uniform, std::max<std::int64_t>(unit.seed, 0));
  unit.cost += 0.6 * std::pow(disks / 95, 3);
}

/// Seconds on one core, measured with 95 disks (docs/simulation.md, docs/ensemble.md); the exponents fit runs
/// with 95 to 400. It orders the units and feeds the estimate of the remaining time.
double cost_of(const EnsembleConfig& config, const std::string& protocol, double disks) {
  const double size = disks / 95;
  const double analysis = config.solver_states ? 0.31 : 0.21;
  const bool implicit = config.molecular_dynamics.gamma > 1e4;
  double rest = 0.0034 * config.sampling.samples;
  if (protocol == "cd1") rest += 0.5;
  if (protocol == "cd2") rest += 0.25;
  if (protocol == "md1") rest += implicit ? 1.2 : 0.7;
  if (protocol == "md2") rest += 0.13;
  return analysis * std::pow(size, 3) + rest * std::pow(size, 1.5);
}

/// `number` of its protocol, from 0.
Unit simulated_unit(const EnsembleConfig& config, const std::string& protocol, std::int64_t number) {
  const std::int64_t seed = config.first_seed + number;
  Unit unit;
  unit.name = fmt::format("{}-{:04}", protocol, seed);
  unit.protocol = protocol;
  unit.seed = seed;
  unit.cost = cost_of(config, protocol, config.scene.disks);
  const sim::Scene scene = scene_of(config, unit);
  unit.config = fmt::format("version = \"{}\"\nprotocol = \"{}\"\n", version(), protocol);
  unit.config += sim::to_toml(scene) + to_toml(method_of(config, protocol));
  if (protocol.back() == '2') unit.config += "# start\n" + to_toml(method_of(config, "cd1"));
  unit.config += analysis_toml(config, seed);
  if (number < config.uniform_seeds) add_uniform_sampling(config, config.scene.disks, unit);
  return unit;
}

Unit unit_of_file(const EnsembleConfig& config, const std::filesystem::path& path, std::int64_t number) {
  Unit unit;
  unit.name = path.stem().string();
  unit.protocol = "file";
  unit.source = path;
  const Hdf5File file = open_indet_file(path);
  unit.seed = file.integer_attribute("/parameters", "seed");
  const auto disks = static_cast<double>(file.shape("/particles/disks/id", 1)[0]);
  unit.cost = cost_of(config, "file", disks);
  unit.config = fmt::format("version = \"{}\"\nfile = \"{}\"\n", version(),
                            file.sha256({"/contacts", "/parameters", "/particles", "/walls"}));
  unit.config += analysis_toml(config, std::max<std::int64_t>(unit.seed, 0));
  if (number < config.uniform_seeds) add_uniform_sampling(config, disks, unit);
  return unit;
}

std::string config_of(const EnsembleConfig& config) {
  std::string text = fmt::format("version = \"{}\"\nfirst_seed = {}\nseeds = {}\nprotocols = [", version(),
                                 config.first_seed, config.protocols.empty() ? 0 : config.seeds);
  for (const std::string& protocol : config.protocols) text += fmt::format("\"{}\", ", protocol);
  text += "]\n";
  if (!config.protocols.empty()) text += sim::to_toml(config.scene.resolved());
  for (const std::string& protocol : config.protocols)
    text += "# " + protocol + "\n" + to_toml(method_of(config, protocol));
  text += analysis_toml(config, -1);
  if (config.uniform_seeds > 0)
    text += uniform_toml(config.uniform, -1) + fmt::format("packings = {}\n", config.uniform_seeds);
  return text;
}

}  // namespace

std::string Plan::hash() const {
  std::string text;
  for (const Unit& unit : units) text += unit.name + " " + unit.hash + "\n";
  return digest(text);
}

sim::Scene scene_of(const EnsembleConfig& config, const Unit& unit) {
  sim::Scene scene = config.scene;
  scene.seed = static_cast<std::uint64_t>(unit.seed);
  return scene.resolved();
}

sim::SimulationOptions method_of(const EnsembleConfig& config, const std::string& protocol) {
  sim::SimulationOptions options;
  if (protocol.starts_with("md")) {
    options.method = sim::Method::kMolecularDynamics;
    options.molecular_dynamics = config.molecular_dynamics;
  } else if (protocol == "cd2") {
    options.contact_dynamics = sim::from_rest_preset();
  }
  return options;
}

Plan make_plan(const EnsembleConfig& config) {
  Plan plan;
  if (!config.protocols.empty()) {
    if (const auto defect = config.scene.defect()) throw InputError(*defect);
    for (const std::string& protocol : config.protocols) {
      for (std::int64_t i = 0; i < config.seeds; ++i)
        plan.units.push_back(simulated_unit(config, protocol, i));
    }
  }
  for (const std::filesystem::path& path : config.files)
    plan.units.push_back(unit_of_file(config, path, &path - config.files.data()));
  if (plan.units.empty()) throw InputError("there is nothing to do: no seed and no file");
  std::set<std::string> names;
  for (Unit& unit : plan.units) {
    unit.number = static_cast<int>(&unit - plan.units.data());
    unit.hash = digest(unit.config);
    if (!names.insert(unit.name).second)
      throw InputError(fmt::format("two packings have the name {}", unit.name));
  }
  plan.config = config_of(config);
  return plan;
}

void write_plan(const std::filesystem::path& folder, const Plan& plan) {
  std::string text =
      "# The packings of this ensemble. Written by indet; indet merge and indet report read it.\n";
  text += fmt::format("config = '''\n{}'''\n", plan.config);
  for (const Unit& unit : plan.units) {
    text +=
        fmt::format("[[unit]]\nname = \"{}\"\nprotocol = \"{}\"\nseed = {}\ncost = {:.3f}\nhash = \"{}\"\n",
                    unit.name, unit.protocol, unit.seed, unit.cost, unit.hash);
  }
  write_whole_file(folder / "ensemble.toml", text);
}

Plan read_plan(const std::filesystem::path& folder) {
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
  const toml::array* units = table["unit"].as_array();
  if (units == nullptr) fail("lists no units");
  for (const toml::node& node : *units) {
    const toml::table* entry = node.as_table();
    if (entry == nullptr) fail("a unit is not a table");
    Unit unit;
    unit.number = static_cast<int>(plan.units.size());
    unit.name = (*entry)["name"].value_or(std::string());
    unit.protocol = (*entry)["protocol"].value_or(std::string());
    unit.seed = (*entry)["seed"].value_or(std::int64_t{-1});
    unit.cost = (*entry)["cost"].value_or(0.0);
    unit.hash = (*entry)["hash"].value_or(std::string());
    if (unit.name.empty() || unit.name.find('/') != std::string::npos || unit.hash.size() != 64)
      fail("a unit has no name or no hash");
    plan.units.push_back(unit);
  }
  return plan;
}

std::filesystem::path unit_path(const std::filesystem::path& folder, const Unit& unit) {
  return folder / "units" / (unit.name + ".h5");
}

std::vector<std::filesystem::path> unit_paths(const std::vector<std::filesystem::path>& folders,
                                              const Plan& plan) {
  std::vector<std::filesystem::path> paths;
  for (const std::filesystem::path& folder : folders) {
    for (const Unit& unit : plan.units) paths.push_back(unit_path(folder, unit));
  }
  return paths;
}

}  // namespace indet
