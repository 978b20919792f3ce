#include <fmt/format.h>

#include <chrono>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/bridge/perturb_record.h"
#include "apps/command.h"
#include "apps/condition.h"
#include "apps/numbers.h"
#include "apps/output_files.h"
#include "apps/packing_input.h"
#include "apps/sample_uniform.h"
#include "apps/say.h"
#include "libindet/base/error.h"
#include "libindet/io/sampling_file.h"
#include "libsim/perturb_sampling.h"

namespace indet::app {
namespace {

struct SampleOptions {
  std::string file, output;
  bool overwrite = false;
  std::string method = "perturb";
  std::uint64_t seed = 0;
  int chains = 0;  ///< 0: the default of the method
  std::vector<std::string> conditions;
  sim::PerturbOptions perturb;
  UniformSettings uniform;
};

/// Throws UsageError if an option was set that the method does not read. Defaults are not refused, so that a
/// stored configuration, which has every option, reads back.
void refuse_unused(const SampleOptions& o) {
  const SampleOptions defaults;
  const sim::PerturbOptions &p = o.perturb, &default_p = defaults.perturb;
  const UniformSettings &u = o.uniform, &default_u = defaults.uniform;
  struct Option {
    const char* name;
    const char* reader;
    bool is_set;
  };
  std::vector<Option> unused;
  if (o.method == "uniform") {
    const char* reader = "--method perturb";
    unused = {{"--samples", reader, p.samples != default_p.samples},
              {"--width", reader, p.width != default_p.width},
              {"--distance", reader, p.distance != default_p.distance},
              {"--tolerance", reader, p.solver.tolerance != default_p.solver.tolerance},
              {"--sweeps", reader, p.solver.max_sweeps != default_p.solver.max_sweeps},
              {"--volume-sweeps", "--shape", !u.shape && u.volume_sweeps != default_u.volume_sweeps}};
  } else {
    const char* reader = "--method uniform";
    unused = {{"--effective", reader, u.sampling.effective != default_u.sampling.effective},
              {"--limit", reader, u.sampling.limit != default_u.sampling.limit},
              {"--states", reader, u.states != default_u.states},
              {"--covariance", reader, u.covariance != default_u.covariance},
              {"--shape", reader, u.shape != default_u.shape},
              {"--volume-sweeps", reader, u.volume_sweeps != default_u.volume_sweeps}};
  }
  for (const Option& option : unused) {
    if (option.is_set)
      throw UsageError(fmt::format("{} has no effect without {}", option.name, option.reader));
  }
}

int run(SampleOptions o, const Context& context) {
  refuse_unused(o);
  const auto begin = std::chrono::steady_clock::now();
  const Hdf5File file = open_packing(o.file);
  Packing packing = read_packing(file);
  apply_conditions(o.conditions, packing, o.file);
  if (!o.output.empty())
    claim_output(o.output, FileKind::kSamples, replacement_rule({o.file}, o.overwrite, context));
  o.uniform.sampling.seed = o.perturb.seed = o.seed;
  if (o.chains != 0) o.uniform.sampling.chains = o.perturb.chains = o.chains;
  if (o.method == "uniform") {
    UniformSettings uniform = o.uniform;
    uniform.conditioned = !o.conditions.empty();
    return sample_uniformly(file, o.output, packing, uniform, context);
  }
  o.perturb.threads = context.thread_count();
  const sim::PerturbEnsemble ensemble = sim::perturb_and_resolve(packing, o.perturb, context.progress());
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const SamplingRecord record = record_of(ensemble, o.perturb);
  if (!o.output.empty()) {
    Provenance provenance{context.arguments, context.resolved_config, {}, {}};
    provenance.seconds["sample"] = seconds;
    write_sampling(o.output, packing, record, provenance);
  }
  if (context.json) {
    nlohmann::json json = {{"file", o.file}, {"method", o.method}, {"seconds", seconds}};
    for (const auto& [name, value] : record.numbers) json[name] = value;
    std::cout << json.dump(2) << '\n';
  } else if (context.prints_report()) {
    say("perturb-and-resolve: {} of {} accepted\n", ensemble.accepted,
        counted(static_cast<std::int64_t>(ensemble.samples.size()), "solution"));
    say("radius r = {:.4g} ± {:.2g} mg about their centre; distances from it vary by {:.4g} mg\n", ensemble.r,
        ensemble.r_error, ensemble.spread);
    say("the centre is {:.4g} mg away from the packing's forces\n", ensemble.start_distance);
    say("accepted solutions balance to {:.1e} mg (before the polish to {:.1e} mg)\n", ensemble.worst_residual,
        ensemble.worst_raw_residual);
    if (!o.output.empty()) say("written to {}\n", o.output);
  }
  const bool all = ensemble.accepted == static_cast<int>(ensemble.samples.size());
  return all ? kDone : kUncertain;
}

void add_perturb_options(CLI::App& command, sim::PerturbOptions& perturb) {
  const std::string group = "Options of --method perturb";
  command.add_option("--samples", perturb.samples, "Number of solutions to draw")
      ->capture_default_str()
      ->group(group);
  command
      .add_option("--width", perturb.width,
                  "Each force is multiplied by a random number between 1 - WIDTH and 1 + WIDTH")
      ->capture_default_str()
      ->group(group);
  command
      .add_option("--distance", perturb.distance,
                  "Solve until balanced forces are at most this far away (mg, norm over all contacts)")
      ->capture_default_str()
      ->group(group);
  command
      .add_option("--tolerance", perturb.solver.tolerance,
                  "... or until no force changes by more than this in a sweep (mg)")
      ->capture_default_str()
      ->group(group);
  command.add_option("--sweeps", perturb.solver.max_sweeps, "Largest number of sweeps per solution")
      ->capture_default_str()
      ->group(group);
}

void add_uniform_options(CLI::App& command, UniformSettings& uniform) {
  const std::string group = "Options of --method uniform";
  command
      .add_option("--effective", uniform.sampling.effective,
                  "Sample until R-hat <= 1.01, and until every R, every T and the norm have this many "
                  "effective samples (docs/sampling.md)")
      ->capture_default_str()
      ->group(group);
  command
      .add_option("--limit", uniform.sampling.limit,
                  "... or until each chain has made this many sweeps (the exit status is then 5)")
      ->capture_default_str()
      ->group(group);
  command.add_option("--states", uniform.states, "Number of sampled states to write to the file")
      ->check(not_negative())
      ->capture_default_str()
      ->group(group);
  command
      .add_flag("--covariance", uniform.covariance,
                "Also write the covariances of all R and T, 2M x 2M numbers")
      ->group(group);
  command
      .add_flag(
          "--shape", uniform.shape,
          "Also find the diameter, the mean width and the volume of the polytope, from the force ranges in "
          "the file (which are computed if it has none)")
      ->group(group);
  command.add_option("--volume-sweeps", uniform.volume_sweeps, "For the volume: sweeps per chain and phase")
      ->check(CLI::Range(10, 100000000))
      ->capture_default_str()
      ->group(group);
}

}  // namespace

Command add_sample(CLI::App& root) {
  const auto options = std::make_shared<SampleOptions>();
  sim::PerturbOptions& perturb = options->perturb;
  CLI::App* command =
      root.add_subcommand("sample", "Draw many of the contact states that a packing can have");
  command->add_option("file", options->file, "HDF5 file of a packing; perturb needs simulated forces in it")
      ->required()
      ->check(CLI::ExistingFile);
  command
      ->add_option(
          "--method", options->method,
          "perturb: perturb the forces and solve for balanced ones again, as the paper does; uniform: all "
          "states of the polytope equally likely")
      ->check(CLI::IsMember({"perturb", "uniform"}))
      ->capture_default_str();
  command
      ->add_option(
          "--chains", options->chains,
          "Number of independent chains that the samples are drawn in (0: one for perturb, which starts "
          "from the packing's forces; four for uniform, which start far apart)")
      ->check(not_negative())
      ->capture_default_str();
  command->add_option("--seed", options->seed, "Seed of the random numbers")->capture_default_str();
  add_condition_option(*command, options->conditions);
  add_perturb_options(*command, perturb);
  add_uniform_options(*command, options->uniform);
  command->add_option("-o,--output", options->output,
                      "HDF5 file to write, with the packing and the samples (default: none)");
  add_overwrite_option(*command, options->overwrite);
  return {command, [options](const Context& context) { return run(*options, context); }};
}

}  // namespace indet::app
