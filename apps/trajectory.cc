#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "apps/command.h"
#include "apps/numbers.h"
#include "apps/output_files.h"
#include "apps/packing_input.h"
#include "apps/say.h"
#include "libindet/base/error.h"
#include "libindet/drawing/trajectory_picture.h"
#include "libindet/io/simulation_file.h"

namespace indet::app {
namespace {

struct TrajectoryOptions {
  std::string file, output;
  bool overwrite = false;
  int frames = 6;
  bool animate = false;
  double seconds = 10;
};

int run(const TrajectoryOptions& o, const Context& context) {
  const Hdf5File file = open_packing(o.file);
  const Packing packing = read_packing(file);
  const Trajectory trajectory = read_trajectory(file);
  if (trajectory.empty() || trajectory.front().positions.size() != packing.disks.size()) {
    throw InputError(fmt::format("{}: the trajectory does not fit its packing", o.file));
  }
  if (std::filesystem::path(o.output).extension() != ".svg") {
    throw InputError(fmt::format("{}: must end with .svg", o.output));
  }
  claim_output(o.output, FileKind::kPicture, replacement_rule({o.file}, o.overwrite, context));
  if (o.animate) {
    draw_trajectory_animation(o.output, packing, trajectory, o.seconds);
  } else {
    draw_trajectory_strip(o.output, packing, trajectory, o.frames);
  }
  if (context.json) {
    std::cout << nlohmann::json{{"output", o.output},
                                {"frames", trajectory.size()},
                                {"begin", trajectory.front().time},
                                {"end", trajectory.back().time}}
                     .dump(2)
              << '\n';
  } else if (context.prints_report()) {
    say("{} from t = {:.4g} to {:.4g}\nwritten to {}\n",
        counted(static_cast<std::int64_t>(trajectory.size()), "frame"), trajectory.front().time,
        trajectory.back().time, o.output);
  }
  return kDone;
}

}  // namespace

Command add_trajectory(CLI::App& root) {
  const auto options = std::make_shared<TrajectoryOptions>();
  CLI::App* command = root.add_subcommand("trajectory", "Draw the frames that simulate --every stored");
  command
      ->add_option("file", options->file, "HDF5 file of a packing with a trajectory (from simulate --every)")
      ->required()
      ->check(CLI::ExistingFile);
  command->add_option("-o,--output", options->output, "SVG file to write")->required();
  add_overwrite_option(*command, options->overwrite);
  command->add_option("--frames", options->frames, "Number of frames that are drawn side by side")
      ->check(positive())
      ->capture_default_str();
  command->add_flag("--animate", options->animate, "Draw one animated picture of all frames instead");
  command->add_option("--seconds", options->seconds, "Duration of the animation in seconds")
      ->check(positive())
      ->capture_default_str();
  return {command, [options](const Context& context) { return run(*options, context); }};
}

}  // namespace indet::app
