#include "apps/simulate_arguments.h"

#include "apps/numbers.h"
#include "libsim/molecular_preset.h"

namespace indet::app {

void add_scene_options(CLI::App& command, SimulateOptions& o) {
  const char* group = "Scene";
  command.add_option("--scene", o.scene_file, "TOML file of the scene")
      ->check(CLI::ExistingFile)
      ->group(group);
  command.add_option("--disks", o.disks, "Number of disks (default: 95)")->group(group);
  command.add_option("--radius", o.radius, "Smallest and largest radius (default: 0.7,1)")
      ->delimiter(',')
      ->expected(2)
      ->group(group);
  command.add_option("--density", o.density, "Mass per area (default: 1)")->group(group);
  command.add_option("--mu", o.mu, "Friction coefficient (default: 0.3, or that of --from)")->group(group);
  command.add_option("--wall-mu", o.wall_mu, "Friction coefficient of the walls (default: that of --mu)")
      ->group(group);
  command.add_option("--gravity", o.gravity, "Acceleration of gravity x,y (default: 0,-1)")
      ->delimiter(',')
      ->expected(2)
      ->group(group);
  command.add_option("--force-unit", o.force_unit, "Unit of force of a scene without gravity")->group(group);
  command.add_option("--container", o.container, "Walls: box, floor, funnel or none (default: box)")
      ->group(group);
  command.add_option("--width", o.width, "Width Lx of the container (default: 2.2 largest radii per column)")
      ->group(group);
  command
      .add_option(
          "--height", o.height,
          "Height Ly of the grid, from which the time limit follows (default: 2 largest radii per row)")
      ->group(group);
  command.add_option("--funnel-angle", o.funnel_angle, "Slope of the funnel, degrees (default: 30)")
      ->group(group);
  command
      .add_option("--columns", o.columns,
                  "Columns of the grid (default: as many as keep the shape of the box)")
      ->group(group);
  command
      .add_option("--jitter", o.jitter,
                  "How much of the free room in its cell a disk is moved by at random, 0 to 1 (default: 1)")
      ->group(group);
}

void add_method_options(CLI::App& command, SimulateOptions& o) {
  const char* group =
      "Method (in units of mg, r_max, sqrt(r_max/g); cd: contact dynamics, md: molecular dynamics)";
  command.add_option("--dt", o.dt, "Time step (default: 1e-3 for cd; for md, what is stable)")->group(group);
  command
      .add_option("--tolerance", o.tolerance,
                  "Sweeps end when no force changes by more than this (default: 1e-6 for cd, 1e-7 for md)")
      ->group(group);
  command.add_option("--sweeps", o.sweeps, "Largest number of sweeps per step (default: cd 100, md 1000)")
      ->group(group);
  command
      .add_option("--start-sweeps", o.start_sweeps,
                  "cd: the same for steps that start from no forces, as the first of cd2 (default: 100000)")
      ->group(group);
  command
      .add_option(
          "--alpha", o.alpha,
          "cd: fraction of an overlap that is removed per step (default: 0, overlaps stay as they are)")
      ->group(group);
  command.add_option("--restitution", o.restitution, "cd: coefficient of normal restitution (default: 0)")
      ->group(group);
  command
      .add_option("--tangential-restitution", o.tangential_restitution,
                  "cd: coefficient of tangential restitution (default: 0)")
      ->group(group);
  command
      .add_option(
          "--preset", o.preset,
          "md: stiffness and damping of contacts: 1.2e5, 7.7e4 (paper); 1.2e6, 7.7e4 (paper-overlap); "
          "1.2e6, 558 (stiff)")
      ->check(CLI::IsMember(sim::molecular_preset_names()))
      ->capture_default_str()
      ->group(group);
  command.add_option("--stiffness", o.stiffness, "md: spring constant k of a contact")->group(group);
  command.add_option("--damping", o.damping, "md: damping constant gamma of a contact")->group(group);
  command.add_option("--damping-method", o.damping_method, "md: how damping is integrated in time")
      ->check(CLI::IsMember({"automatic", "explicit", "implicit"}))
      ->capture_default_str()
      ->group(group);
  command
      .add_option("--residual", o.residual,
                  "At rest means: forces balance to this (default: 1e-4 for cd, 1e-6 for md) ...")
      ->group(group);
  command
      .add_option("--kinetic-energy", o.kinetic_energy,
                  "... and the kinetic energy per disk is below this (default: 1e-12)")
      ->group(group);
  command.add_option("--time-limit", o.time_limit, "Largest simulated time (default: 6 sqrt(Ly/g))")
      ->group(group);
}

void add_tilt_options(CLI::App& command, SimulateOptions& o) {
  const char* group = "Tilt (of the packing of --from, by the simulator of --protocol; angles in degrees)";
  command
      .add_option("--tilt-rate", o.tilt_rate,
                  "Turn gravity until disks move, by so many degrees per sqrt(r_max/g); positive: "
                  "counter-clockwise. 0.02 finds angles to about 0.1 degrees")
      ->group(group);
  command.add_option("--tilt-limit", o.tilt_limit, "Turn it no further than this")
      ->check(positive())
      ->capture_default_str()
      ->group(group);
  command.add_option("--tilt-moved", o.tilt_moved, "End when so many disks have moved")
      ->check(CLI::PositiveNumber)
      ->capture_default_str()
      ->group(group);
  command
      .add_option("--tilt-distance", o.tilt_distance,
                  "A disk has moved once its centre is further than this, in r_max, from where it was")
      ->check(positive())
      ->capture_default_str()
      ->group(group);
  command
      .add_option(
          "--tilt-every", o.tilt_every,
          "Interval of angle between the states of which the file tells, and to which the packing that is "
          "written belongs")
      ->check(positive())
      ->capture_default_str()
      ->group(group);
}

}  // namespace indet::app
