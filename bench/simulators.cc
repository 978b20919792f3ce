#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iostream>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "libsim/molecular_preset.h"
#include "libsim/scene.h"
#include "libsim/simulate.h"
#include "libsim/static_solver.h"

/// Speed of the simulators, and the problems that bench/peers gives to other programs.
///
///   bench_simulators scaling              cost per particle-step and per contact update, N = 95 … 6400
///   bench_simulators md N STEPS FOLDER    MD (stiff) of N disks that have fallen; atoms.csv for LAMMPS;
///                                         prints the processor time of a run for each line on stdin
///   bench_simulators statics N MU FOLDER  a frozen CD packing as CSV; reads tolerances from stdin and prints
///                                         "seconds residual sweeps" of the Gauss–Seidel solver from F = 0
///                                         for each
namespace {

using namespace indet;
using namespace indet::sim;

/// The fastest of so many runs counts: other programs on the machine only slow one down.
constexpr int kRepeats = 3;

/// Processor time of this process: what others do on the machine enters as little as can be.
double seconds_used() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

Scene scene_of(int disks, double mu = 0.3) {
  Scene scene;
  scene.disks = disks;
  scene.friction = {mu, mu};
  return scene;
}

/// A bed of disks as dense as at rest: a wide box with few rows settles in a short time whatever its size.
Scene bed_of(int disks) {
  Scene scene = scene_of(disks);
  scene.columns = std::max(5, disks / 19);
  return scene;
}

SimulationOptions stiff_springs() {
  SimulationOptions options;
  options.simulator = Simulator::kMolecularDynamics;
  options.molecular_dynamics = options_of(MolecularPreset::kStiff);
  options.time_limit = 1;
  return options;
}

/// Contact dynamics with few sweeps: dense in a short time, if not at rest.
SimulationOptions coarse_contacts() {
  SimulationOptions options;
  options.time_limit = 1;
  options.contact_dynamics.max_sweeps = 40;
  return options;
}

/// State after `time`.
World fallen(const World& start, const SimulationOptions& options, double time) {
  const auto stepper = make_stepper(start, {}, options);
  stepper->advance(static_cast<int>(time * start.units().time / stepper->dt()));
  return stepper->world();
}

void scaling() {
  fmt::print("{:>6} {:>22} {:>24} {:>10}\n", "N", "MD ns/particle-step", "CD ns/contact update", "contacts");
  for (const int disks : {95, 400, 1600, 6400}) {
    const World world = build(bed_of(disks));
    SimulationOptions rigid;
    rigid.time_limit = 1;
    const World dense = fallen(world, coarse_contacts(), 12);

    const auto md = make_stepper(dense, {}, stiff_springs());
    const int steps = 40000000 / disks / 4;
    md->advance(steps / 4);
    const double md_start = seconds_used();
    md->advance(steps);
    const double md_cost = (seconds_used() - md_start) / (static_cast<double>(steps) * disks);

    const auto cd = make_stepper(dense, {}, rigid);
    cd->advance(20);
    const auto updates = cd->report().contact_updates;
    const double cd_start = seconds_used();
    cd->advance(std::max(20, 200000 / disks));
    const double cd_cost =
        (seconds_used() - cd_start) / static_cast<double>(cd->report().contact_updates - updates);
    fmt::print("{:>6} {:>22.1f} {:>24.2f} {:>10}\n", disks, md_cost * 1e9, cd_cost * 1e9,
               cd->report().contacts);
  }
}

void md(int disks, int steps, const std::string& folder) {
  const Scene scene = bed_of(disks);
  const World world = fallen(build(scene), coarse_contacts(), 15);
  std::ofstream atoms(folder + "/atoms.csv");
  atoms << "x,y,radius,mass\n";
  for (int i = 0; i < world.size(); ++i) {
    atoms << fmt::format("{:.17g},{:.17g},{:.17g},{:.17g}\n", world.x[i], world.y[i], world.radius[i],
                         world.mass[i]);
  }
  World start = world;
  start.bring_to_rest();
  atoms.close();
  const Units units = world.units();
  fmt::print(
      "{{\"dt\": {:.17g}, \"k\": {:.17g}, \"gamma\": {:.17g}, \"width\": {}, \"mu\": 0.3, "
      "\"mass\": {:.17g}}}\n",
      make_stepper(start, {}, stiff_springs())->dt(), 1.2e6 * units.stiffness(), 558 * units.damping(),
      scene.resolved().width, units.mass);
  std::fflush(stdout);
  for (std::string line; std::getline(std::cin, line);) {
    const double begin = seconds_used();
    make_stepper(start, {}, stiff_springs())->advance(steps);
    fmt::print("{}\n", seconds_used() - begin);
    std::fflush(stdout);
  }
}

/// Of the first seed whose disks come to rest: where nothing balances, solvers have nothing to agree on.
Packing balanced_packing(int disks, double mu) {
  Scene scene = scene_of(disks, mu);
  for (;; ++scene.seed) {
    const World world = build(scene);
    SimulationOptions options;
    options.time_limit = default_time_limit(world, scene.resolved().height);
    Simulation simulation = simulate(world, {}, options);
    if (simulation.settled.ending == Ending::kStatic && simulation.polished.balanced)
      return std::move(simulation.packing);
  }
}

void statics(int disks, double mu, const std::string& folder) {
  const Packing packing = balanced_packing(disks, mu);
  std::ofstream bodies(folder + "/disks.csv");
  bodies << "radius,mass,inertia\n";
  for (const Disk& disk : packing.disks) {
    bodies << fmt::format("{:.17g},{:.17g},{:.17g}\n", disk.radius, disk.mass, disk.inertia);
  }
  std::ofstream contacts(folder + "/contacts.csv");
  contacts << "a,b,nx,ny,mu\n";
  for (const Contact& c : packing.contacts) {
    contacts << fmt::format("{},{},{:.17g},{:.17g},{}\n", c.a.value(), c.b.code(), c.normal.x(), c.normal.y(),
                            c.mu);
  }
  contacts.close();
  bodies.close();
  fmt::print("ready {:.17g}\n", packing.force_unit());
  std::fflush(stdout);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(2 * packing.contact_count());
  for (double tolerance = 0; std::cin >> tolerance;) {
    double seconds = std::numeric_limits<double>::infinity();
    StaticForces result;
    for (int i = 0; i < kRepeats; ++i) {
      const double begin = seconds_used();
      result = solve_statics(packing, zero, {.tolerance = tolerance, .max_sweeps = 2000000});
      seconds = std::min(seconds, seconds_used() - begin);
    }
    std::ofstream forces(folder + "/forces.csv");
    for (const double force : result.forces) forces << fmt::format("{:.17g}\n", force);
    forces.close();
    fmt::print("{} {} {}\n", seconds, result.residual, result.sweeps);
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.size() == 1 && arguments[0] == "scaling") {
    scaling();
  } else if (arguments.size() == 4 && arguments[0] == "md") {
    md(std::stoi(arguments[1]), std::stoi(arguments[2]), arguments[3]);
  } else if (arguments.size() == 4 && arguments[0] == "statics") {
    statics(std::stoi(arguments[1]), std::stod(arguments[2]), arguments[3]);
  } else {
    std::cerr << "usage: bench_simulators scaling | md N STEPS FOLDER | statics N MU FOLDER\n";
    return 2;
  }
  return 0;
}
