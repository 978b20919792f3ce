#include "libindet/sampling/limit_walk.h"

#include <cmath>
#include <utility>

#include "libindet/base/error.h"
#include "libindet/base/tolerances.h"
#include "libindet/equilibrium/contact_state.h"
#include "libindet/polytope/force_polytope.h"
#include "libindet/range/analyze.h"
#include "libindet/sampling/convex_body.h"
#include "libindet/sampling/shape.h"
#include "libindet/sampling/uniform_sampling.h"
#include "libindet/statistics/convergence.h"

namespace indet {
namespace {

/// NaN where a value is.
double largest(const Eigen::VectorXd& values) {
  return values.size() == 0 ? 0 : values.maxCoeff<Eigen::PropagateNaN>();
}
double mean(const Eigen::VectorXd& values) { return values.size() == 0 ? 0 : values.mean(); }

/// M_s of every state of a sample, chain after chain.
std::vector<double> sliding_contacts(const Packing& packing, const ConvexBody& body,
                                     const UniformSample& sample) {
  std::vector<double> counts;
  for (Eigen::Index i = 0; i < sample.z.cols(); ++i) {
    const SceneForces state = body.units.scene(InternalForces(body.states(sample.z.col(i)).value()));
    counts.push_back(count_coulomb(packing, state, tolerance::kSliding).sliding);
  }
  return counts;
}

/// What is found of F at one step.
class StepFinder {
 public:
  /// `unit`: mg of the packing as it is, in the scene's units.
  StepFinder(Packing packing, double unit, const LimitWalkOptions& options)
      : packing_(std::move(packing)), unit_(unit), options_(options) {}

  LimitStep find(double value) {
    step_.value = value;
    find_ranges();
    if (step_.dim < 0) return step_;
    const ForcePolytope polytope = find_force_polytope(packing_);
    if (polytope.dim != step_.dim) {  // the analysis has decided by exact arithmetic
      step_.is_doubtful = 1;
      return step_;
    }
    if (polytope.status == PolytopeStatus::kPoint) describe_point(polytope);
    if (polytope.status == PolytopeStatus::kBounded) sample(polytope);
    return step_;
  }

 private:
  void find_ranges() {
    AnalyzeOptions options = options_for(Accuracy::kFast);
    options.states.kind = StateChoice::Kind::kNone;
    options.reactions = false;
    options.threads = options_.threads;
    options.progress = options_.progress;
    const ForceRanges ranges = analyze(packing_, options);
    step_.dim = ranges.dim;
    step_.is_doubtful = ranges.doubtful ? 1 : 0;
    step_.imprecise = static_cast<int>(ranges.imprecise);
    step_.failed = static_cast<int>(ranges.failed);
    if (ranges.status == PolytopeStatus::kEmpty) return;
    const double scale = ranges.force_unit / unit_;
    step_.mean_delta_R = scale * mean(ranges.delta_R);
    step_.largest_delta_R = scale * largest(ranges.delta_R);
    step_.mean_delta_T = scale * mean(ranges.delta_T);
    step_.largest_delta_T = scale * largest(ranges.delta_T);
  }

  void describe_point(const ForcePolytope& polytope) {
    const InternalForces state = polytope.problem.state(polytope.lightest);
    step_.most_sliding =
        count_coulomb(packing_, polytope.problem.units.scene(state), tolerance::kSliding).sliding;
    step_.sliding = step_.most_sliding;
    step_.sliding_error = 0;
    step_.r = step_.r_error = step_.inscribed_radius = step_.mean_width = step_.mean_width_error = 0;
  }

  void sample(const ForcePolytope& polytope) {
    const ConvexBody body = make_body(polytope);
    UniformOptions options;
    options.effective = options_.effective;
    options.seed = options_.seed;
    options.threads = options_.threads;
    options.progress = options_.progress;
    const UniformSample sample = sample_uniformly(body, options);
    step_.converged = sample.converged ? 1 : 0;
    const double internal = body.units.internal_in_scene() / unit_;
    step_.r = internal * sample.r.value();
    step_.r_error = internal * sample.r_error.value();
    count_sliding(body, sample);
    ShapeOptions shape_options;
    shape_options.seed = options_.seed;
    shape_options.progress = options_.progress;
    const PolytopeShape shape = measure_shape(body, sample, nullptr, shape_options);
    const double weight = packing_.force_unit() / unit_;
    step_.inscribed_radius = weight * shape.inscribed_radius;
    step_.mean_width = weight * shape.mean_width;
    step_.mean_width_error = weight * shape.mean_width_error;
  }

  void count_sliding(const ConvexBody& body, const UniformSample& sample) {
    const std::vector<double> counts = sliding_contacts(packing_, body, sample);
    const Eigen::Map<const Eigen::VectorXd> all(counts.data(), static_cast<Eigen::Index>(counts.size()));
    step_.sliding = all.mean();
    step_.most_sliding = static_cast<int>(all.maxCoeff());
    const double variance = (all.array() - all.mean()).square().mean();
    step_.sliding_error =
        variance > 0
            ? std::sqrt(variance / ChainAssessor(sample.chains, sample.length).effective_size(counts))
            : 0;
  }

  Packing packing_;
  double unit_;
  const LimitWalkOptions& options_;
  LimitStep step_;
};

}  // namespace

std::vector<LimitStep> walk_to_limit(const Packing& packing, const Limit& limit, const LimitEnd& end,
                                     int steps, const LimitWalkOptions& options) {
  const std::vector<double> values = step_values(limit.present(), end.value, steps);
  std::vector<LimitStep> found;
  LimitWalkOptions inner = options;
  if (options.progress) {
    inner.progress = [&](const Progress& progress) {
      return options.progress({"steps", std::ssize(found), std::ssize(values), progress.stage});
    };
  }
  for (const double value : values) {
    if (inner.progress && !inner.progress({})) throw Interrupted();
    found.push_back(StepFinder(packing_at(packing, limit, value), packing.force_unit(), inner).find(value));
  }
  return found;
}

}  // namespace indet
