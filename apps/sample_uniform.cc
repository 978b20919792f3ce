#include "apps/sample_uniform.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>

#include "apps/bridge/uniform_record.h"
#include "apps/say.h"
#include "libindet/base/error.h"
#include "libindet/base/tolerances.h"
#include "libindet/equilibrium/contact_state.h"
#include "libindet/io/ranges_file.h"
#include "libindet/io/sampling_file.h"
#include "libindet/packing/force_bounds.h"
#include "libindet/range/analyze.h"
#include "libindet/sampling/placement.h"
#include "libindet/sampling/shape.h"
#include "libindet/sampling/volume.h"

namespace indet::app {
namespace {

/// The contacts whose forces grow along the ray, strongest first; largest entry 1.
std::string describe_ray(const Packing& packing, const ForcePolytope& polytope) {
  Eigen::VectorXd forces = polytope.problem.state(polytope.ray).value();
  forces /= forces.lpNorm<Eigen::Infinity>();
  for (double& force : forces)
    force = std::abs(force) < tolerance::kRayEntry ? 0 : force;  // rounding around 0
  std::vector<int> growing;
  for (int k = 0; k < packing.contact_count(); ++k)
    if (forces[2 * k] > tolerance::kRayEntry) growing.push_back(k);
  std::stable_sort(growing.begin(), growing.end(),
                   [&](int a, int b) { return forces[2 * a] > forces[2 * b]; });
  constexpr std::size_t kShown = 6;
  std::string text;
  for (std::size_t i = 0; i < std::min(kShown, growing.size()); ++i) {
    const int k = growing[i];
    text += fmt::format("{}contact {} ({}) by R {:+.3g}, T {:+.3g}", i > 0 ? "; " : "", k,
                        contact_name(packing, ContactId(k)), forces[2 * k], forces[2 * k + 1]);
  }
  if (growing.size() > kShown)
    text += "; and " + counted(static_cast<std::int64_t>(growing.size() - kShown), "more contact");
  return text;
}

/// Everything that was found, before it is printed or written.
struct Findings {
  ForcePolytope polytope;
  std::optional<ConvexBody> body;  ///< none: F is a point
  UniformSample sample;
  std::optional<Placement> placement;
  std::optional<PolytopeShape> shape;
  std::optional<VolumeEstimate> volume;
  double worst_residual = 0;  ///< ‖cF + w‖∞ over the states that are written, and the centre (mg)
};

std::map<std::string, double> numbers_of(const Findings& f, const UniformSettings& settings) {
  std::map<std::string, double> numbers =
      f.body ? numbers_of(f.polytope, f.sample, settings.sampling)
             : numbers_of_point(f.sample, f.polytope.problem.units, settings.sampling);
  numbers["worst_residual"] = f.worst_residual;
  if (f.placement) numbers.merge(numbers_of(*f.placement));
  if (f.shape) {
    numbers.insert({{"diameter_lower", f.shape->diameter_lower},
                    {"diameter_upper", f.shape->diameter_upper},
                    {"diameter_by_ranges", f.shape->diameter_by_ranges},
                    {"mean_width", f.shape->mean_width},
                    {"mean_width_error", f.shape->mean_width_error},
                    {"unsolved_widths", f.shape->unsolved},
                    {"log_volume", f.volume->log_volume},
                    {"log_volume_error", f.volume->error},
                    {"volume_phases", f.volume->phases}});
  }
  return numbers;
}

void print(const Packing& packing, const Findings& f, const UniformSettings& settings) {
  const UniformSample& s = f.sample;
  const auto mg = [&](const InternalForce& force) { return f.polytope.problem.units.weights(force).value(); };
  if (!f.body) {
    say("polytope of contact states: a point; the only state has the norm ‖F‖ = {:.4g} mg\n",
        mg(s.mean_norm));
    return;
  }
  say("polytope of contact states: dimension {}, {}\n", f.polytope.dim,
      counted(static_cast<std::int64_t>(f.polytope.blocks.size()), "independent block"));
  say("radius r = {:.4g} ± {:.2g} mg about the centre; distances from it vary by {:.4g} mg\n", mg(s.r),
      mg(s.r_error), mg(s.spread));
  say("norm ‖F‖: mean {:.4g} mg, standard deviation {:.2g} mg\n", mg(s.mean_norm), mg(s.norm_deviation));
  const std::string slowest =
      s.slowest == 2 * packing.contact_count()
          ? "‖F‖"
          : fmt::format("{} of contact {}", s.slowest % 2 == 0 ? "R" : "T", s.slowest / 2);
  say("{} after {} sweeps of each of {} chains: R-hat at most {:.4f}; at least {:.0f} (bulk) and {:.0f} "
      "(tail) effective samples of each quantity, fewest of {}\n",
      s.converged ? "converged" : fmt::format("NOT converged (limit {})", settings.sampling.limit), s.sweeps,
      s.chains, s.rhat, s.bulk, s.tail, slowest);
  if (f.placement) {
    say("simulated state among the samples: {:.4g} mg from the centre (percentile {:.1f}); percentile {:.1f} "
        "of the norm, {:.1f} of ΣR\n",
        f.placement->distance, f.placement->distance_percentile, f.placement->norm_percentile,
        f.placement->normal_force_percentile);
  }
  if (f.shape) {
    say("size: largest ball inside of radius {:.4g} mg; diameter between {:.4g} and {:.4g} mg; mean width "
        "{:.4g} ± {:.2g} mg\n",
        f.shape->inscribed_radius, f.shape->diameter_lower, f.shape->diameter_upper, f.shape->mean_width,
        f.shape->mean_width_error);
    if (f.shape->unsolved > 0)
      say("NOT solved: {} for widths\n", counted(f.shape->unsolved, "linear program"));
    say("natural logarithm of the volume (mg to the power {}): {:.4g} ± {:.2g}\n", f.polytope.dim,
        f.volume->log_volume, f.volume->error);
  }
}

void find_shape(const Hdf5File& file, const Packing& packing, const UniformSettings& settings,
                const Context& context, Findings& f, std::optional<ForceRanges>& ranges) {
  if (has_ranges(file) && !settings.conditioned) {
    ranges = read_ranges(file);
  } else {
    AnalyzeOptions options;
    options.threads = context.thread_count();
    options.progress = context.progress();
    ranges = analyze(packing, options);
  }
  ShapeOptions shape;
  shape.seed = settings.sampling.seed;
  shape.progress = context.progress();
  f.shape = measure_shape(*f.body, f.sample, &*ranges, shape);
  VolumeOptions volume;
  volume.sweeps = settings.volume_sweeps;
  volume.seed = settings.sampling.seed;
  volume.threads = context.thread_count();
  volume.progress = context.progress();
  f.volume = estimate_volume(*f.body, f.sample, volume);
}

/// Recomputes the balance of states, contact by contact from the packing. Throws LibraryError if one does not
/// balance.
void check_balance(const Packing& packing, const Eigen::MatrixXd& states, Findings& f) {
  const ForceUnits& units = f.polytope.problem.units;
  for (Eigen::Index i = 0; i < states.cols(); ++i) {
    if (packing.disk_count() == 0) continue;
    const InternalForces state(states.col(i));
    const double largest = state.value().size() > 0 ? state.value().lpNorm<Eigen::Infinity>() : 0.0;
    const double allowed =
        units.weights(InternalForce(tolerance::kSampleResidual * std::max(1.0, largest))).value();
    const double residual = largest_imbalance(packing, units.scene(state));
    f.worst_residual = std::max(f.worst_residual, residual);
    if (!(residual <= allowed)) {
      throw LibraryError(fmt::format(
          "a sampled contact state does not balance the load: the net force on a disk is {:.1e} mg",
          residual));
    }
  }
}

}  // namespace

int sample_uniformly(const Hdf5File& file, const std::string& output, const Packing& packing,
                     UniformSettings settings, const Context& context) {
  const std::string path = file.path().string();
  settings.sampling.threads = context.thread_count();
  settings.sampling.progress = context.progress();
  if (const auto reason = settings.sampling.defect()) throw UsageError(*reason);
  Findings f;
  f.polytope = find_force_polytope(packing);
  if (f.polytope.status == PolytopeStatus::kEmpty) {
    if (context.json) {
      const nlohmann::json json = {{"file", path}, {"method", "uniform"}, {"stopped_by", "empty"}};
      std::cout << json.dump(2) << '\n';
    }
    if (!force_bounds(packing).empty()) {
      context.warn(fmt::format(
          "{}: no contact forces keep to balance, friction and the bounds of forces; indet analyze{} "
          "tells which bounds contradict each other",
          path, settings.conditioned ? " with the same --condition" : ""));
      return f.polytope.doubtful ? kUncertain : kNoAdmissibleState;
    }
    context.warn(fmt::format(
        "{0}: the packing cannot stand: no contact forces balance its load; indet analyze {0} tells "
        "which disks move",
        path));
    return f.polytope.doubtful ? kUncertain : kNoAdmissibleState;
  }
  if (f.polytope.status == PolytopeStatus::kUnbounded) {
    throw InputError(
        fmt::format("{}: some contact forces can grow without limit, so no distribution over all states is "
                    "uniform; together can grow {}",
                    path, describe_ray(packing, f.polytope)));
  }
  std::optional<ForceRanges> ranges;
  if (f.polytope.status == PolytopeStatus::kPoint) {
    f.sample = sample_of_point(f.polytope);
  } else {
    f.body = make_body(f.polytope);
    f.sample = indet::sample_uniformly(*f.body, settings.sampling);
    if (settings.shape) find_shape(file, packing, settings, context, f, ranges);
    if (packing.has_simulated_forces()) {
      f.placement =
          place_state(packing, *f.body, f.sample, packing.simulated_forces(), ranges ? &*ranges : nullptr);
    }
  }
  const int states = f.body ? std::min(settings.states, f.sample.count()) : 0;
  if (f.body) check_balance(packing, some_states(*f.body, f.sample, std::max(states, 1)).value(), f);
  check_balance(packing, f.sample.center.value(), f);

  const ForceUnits& units = f.polytope.problem.units;
  SamplingRecord record{"uniform", units.scene(f.sample.center).value(), numbers_of(f, settings), {}};
  if (f.body) {
    record.components = components_of(*f.body, f.sample);
    record.components->states = units.scene(some_states(*f.body, f.sample, states)).value();
    if (settings.covariance)
      record.components->covariance = units.internal_in_scene() * units.internal_in_scene() * f.body->frame *
                                      f.sample.covariance * f.body->frame.transpose();
  }
  if (!output.empty()) {
    Provenance provenance{context.arguments, context.resolved_config, {}, {}};
    provenance.seconds["sample"] = f.sample.seconds;
    write_sampling(output, packing, record, provenance);
  }
  if (context.json) {
    nlohmann::json json = {{"file", path}, {"method", "uniform"}, {"seconds", f.sample.seconds}};
    json["core_seconds"] = f.sample.core_seconds;
    json["stopped_by"] = !f.body ? "point" : f.sample.converged ? "convergence" : "limit";
    for (const auto& [name, value] : record.numbers) json[name] = value;
    std::cout << json.dump(2) << '\n';
  } else if (context.prints_report()) {
    print(packing, f, settings);
    if (!output.empty()) say("written to {} ({:.2f} s)\n", output, f.sample.seconds);
  }
  const bool all = f.sample.converged && (!f.shape || f.shape->unsolved == 0);
  return all && !f.polytope.doubtful ? kDone : kUncertain;
}

}  // namespace indet::app
