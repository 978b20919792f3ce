#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/batch/shard.h"
#include "libindet/sampling/uniform_sampling.h"
#include "libsim/perturb_sampling.h"
#include "libsim/protocol.h"
#include "libsim/scene.h"
#include "libsim/simulate.h"

namespace indet {

/// What an ensemble is: the packings, and what is done with each.
struct EnsembleConfig {
  sim::Scene scene;  ///< Its seed is that of each packing.
  std::int64_t first_seed = 0;
  std::int64_t seeds = 60;
  std::vector<sim::Protocol> protocols = {sim::kSimulated.begin(), sim::kSimulated.end()};
  double time_limit = 0;  ///< Of a simulation, units of time; 0: that of the scene's height.
  sim::ContactDynamicsOptions contact_dynamics;
  sim::MolecularDynamicsOptions molecular_dynamics;
  std::vector<std::filesystem::path> files;  ///< Packings that are there already.
  sim::PerturbOptions sampling;              ///< samples = 0: none. Its seed is that of each packing.
  /// Packings of each protocol that are sampled uniformly too: those of the first seeds, the first files.
  std::int64_t uniform_seeds = 20;
  UniformOptions uniform;  ///< Its seed is that of each packing.
  /// Packings of each protocol that the paper's walk analyses too, of the first seeds or files.
  std::int64_t paper_walk_seeds = 60;
  /// Packings of each protocol whose limits are found too, of the first seeds or files (limits_step.h).
  std::int64_t limit_seeds = 60;
  bool solver_states =
      true;  ///< Also dR and dT of the states that the solver happens to find, as in the paper.
  bool smallest_distances = false;  ///< Also dR_min and dT_min (range/smallest_distances.h).
};

/// One packing of an ensemble.
struct Member {
  int number = 0;    ///< From 0, in the order of the tables.
  std::string name;  ///< "cd1-0007", or the name of its file; its own file is members/NAME.h5.
  sim::Protocol protocol = sim::Protocol::kFile;
  std::int64_t seed = -1;
  std::filesystem::path source;  ///< Of a packing that was there.
  bool uniform = false;          ///< Also sampled uniformly.
  bool paper_walk = false;       ///< Also analysed by the paper's walk.
  bool limits = false;           ///< Also how far it is from yielding.
  double cost = 0;               ///< Estimated seconds on one core.
  std::string config;            ///< Everything that its results depend on, as TOML.
  std::string hash;              ///< SHA-256 of `config`.
};

struct Plan {
  std::string config;  ///< Of the ensemble, TOML.
  std::vector<Member> members;

  /// SHA-256 over names and hashes of all members.
  std::string hash() const;
};

/// Lists the packings of an ensemble. Throws InputError if the scene cannot be built, a file cannot be read,
/// two files have the same name, or there is nothing to do.
Plan make_plan(const EnsembleConfig& config);

/// The members of one share of the work. Those of one seed stay together, so that a protocol finds what it
/// starts from; each share costs about the same.
std::vector<Member> members_of(const Plan& plan, const Shard& shard);
/// Estimated seconds of what is dealt: of each seed, and of each packing of a file.
std::vector<double> dealt_costs(const Plan& plan);

/// "cd1-0007".
std::string simulated_name(sim::Protocol protocol, std::int64_t seed);

/// The scene of a simulated member, and the options of its simulation.
sim::Scene scene_of(const EnsembleConfig& config, const Member& member);
sim::SimulationOptions simulation_options_of(const EnsembleConfig& config, sim::Protocol protocol);

}  // namespace indet
