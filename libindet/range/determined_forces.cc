#include "libindet/range/determined_forces.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "libindet/base/error.h"
#include "libindet/base/tolerances.h"
#include "libindet/polytope/central_polytope.h"
#include "libindet/polytope/motion_rows.h"
#include "libindet/range/functional.h"
#include "libindet/range/sensitivity.h"

namespace indet {
namespace {

class DeterminedForces {
 public:
  DeterminedForces(const ForcePolytope& polytope, BarrierRanges& ranges)
      : problem_(polytope.problem),
        central_(*polytope.central),
        ranges_(ranges),
        first_(problem_.first_unknowns()),
        centre_(problem_.units.scene(problem_.state(Eigen::Map<const Eigen::VectorXd>(
            central_.centre.x.data(), static_cast<Eigen::Index>(central_.centre.x.size()))))) {}

  void enclose(Eigen::Index contact, bool tangential) {
    barrier::Objective objective = force_component(problem_, first_, contact, tangential, 1).on_edges;
    std::erase_if(objective, [](const auto& entry) { return entry.second == 0; });
    barrier::ValueBounds bounds{0, 0};
    double sensitivity = 0;
    if (!objective.empty()) {
      const std::vector<double> y = central_.equations->nearest_multipliers(objective);
      bounds = in_scene_units(central_.equations->enclose_everywhere(objective, y), problem_);
      sensitivity = sensitivity_to_normals(problem_, on_equations(problem_, central_.structure, y), centre_);
    }
    const double size = std::max(problem_.units.weight_in_scene(), std::abs(bounds.lower));
    const bool is_narrow = bounds.upper - bounds.lower <= tolerance::kDeterminedInterval * size;
    for (const int column : {tangential ? kMinT : kMinR, tangential ? kMaxT : kMaxR}) {
      // A calibrating contact has had its values counted.
      ranges_.extrema.determined += objective.empty() && is_counted(contact, column) ? 0 : 1;
      ranges_.extrema.claim(contact, column) = is_narrow ? Outcome::kEnclosed : Outcome::kFailed;
      ranges_.enclosures.lower(contact, column) = bounds.lower;
      ranges_.enclosures.upper(contact, column) = bounds.upper;
      ranges_.enclosures.sensitivity(contact, column) = sensitivity;
    }
  }

 private:
  bool is_counted(Eigen::Index contact, int column) const {
    return ranges_.extrema.claim(contact, column) == Outcome::kEnclosed;
  }

  const EquilibriumProblem& problem_;
  const CentralPolytope& central_;
  BarrierRanges& ranges_;
  std::vector<int> first_;
  SceneForces centre_;
};

}  // namespace

bool is_determined(const CentralWidths& widths, Eigen::Index contact, bool tangential) {
  return widths.width(contact, tangential ? 1 : 0) <= tolerance::kDeterminedWidth * widths.centre(contact, 0);
}

void enclose_determined(const ForcePolytope& polytope, const CentralWidths& widths,
                        const IntervalOptions& options, BarrierRanges& ranges) {
  std::vector<std::pair<Eigen::Index, bool>> forces;
  for (Eigen::Index i = 0; i < widths.width.rows(); ++i) {
    for (const bool tangential : {false, true}) {
      if (is_determined(widths, i, tangential)) forces.emplace_back(i, tangential);
    }
  }
  DeterminedForces determined(polytope, ranges);
  std::int64_t done = 0;
  for (const auto& [contact, tangential] : forces) {
    determined.enclose(contact, tangential);
    if (options.progress && !options.progress(++done, static_cast<std::int64_t>(forces.size())))
      throw Interrupted();
  }
}

}  // namespace indet
