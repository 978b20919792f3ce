#include "libindet/range/determined_forces.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "libindet/base/error.h"
#include "libindet/base/tolerances.h"
#include "libindet/polytope/motion_rows.h"
#include "libindet/range/functional.h"
#include "libindet/range/sensitivity.h"

namespace indet {

bool is_determined(const Packing& packing, const CentralWidths& widths, Eigen::Index contact,
                   bool tangential) {
  const double mu = packing[ContactId(static_cast<int>(contact))].mu;
  const double largest = (tangential ? std::min(1.0, mu) : 1.0) * widths.centre(contact, 0);
  return widths.width(contact, tangential ? 1 : 0) <= tolerance::kDeterminedWidth * largest;
}

DeterminedForces::DeterminedForces(const EquilibriumProblem& problem, const CentralPolytope& central)
    : problem_(problem), central_(central), centre_(central.equations->repaired(central.centre.x)) {
  // A limit has a slack more.
  const Eigen::Map<const Eigen::VectorXd> strengths(centre_.data(), problem.unknowns());
  forces_ = problem.units.scene(problem.state(strengths));
}

ValueInterval DeterminedForces::enclose(const barrier::Objective& objective) const {
  ValueInterval interval;
  interval.x = centre_;
  interval.y = central_.equations->nearest_multipliers(objective);
  const auto [lower, upper] = central_.equations->enclose_everywhere(objective, interval.y);
  interval.lower = lower;
  interval.upper = upper;
  interval.sensitivity =
      sensitivity_to_normals(problem_, on_equations(problem_, central_.structure, interval.y), forces_);
  return interval;
}

bool DeterminedForces::is_proof(const ValueInterval& interval, double gap) const {
  return is_narrow(interval, problem_, std::min(gap, tolerance::kDeterminedInterval));
}

void enclose_determined(const Packing& packing, const ForcePolytope& polytope, const CentralWidths& widths,
                        const IntervalOptions& options, BarrierRanges& ranges) {
  const EquilibriumProblem& problem = polytope.problem;
  std::vector<std::pair<Eigen::Index, bool>> forces;
  for (Eigen::Index i = 0; i < widths.width.rows(); ++i) {
    for (const bool tangential : {false, true}) {
      if (ranges.extrema.claim(i, tangential ? kMinT : kMinR) == Outcome::kNotRequested &&
          is_determined(packing, widths, i, tangential))
        forces.emplace_back(i, tangential);
    }
  }
  const std::vector<int> first = problem.first_unknowns();
  const DeterminedForces determined(problem, *polytope.central);
  std::int64_t done = 0;
  for (const auto& [contact, tangential] : forces) {
    barrier::Objective objective = force_component(problem, first, contact, tangential, 1);
    std::erase_if(objective, [](const auto& entry) { return entry.second == 0; });
    ValueInterval interval{0, 0, 0, 0, {}, {}};
    if (!objective.empty()) interval = determined.enclose(objective);
    const auto [lower, upper] = value_bounds({interval.lower, interval.upper}, 1, problem);
    const bool is_proven = determined.is_proof(interval, options.gap);
    for (const int column : {tangential ? kMinT : kMinR, tangential ? kMaxT : kMaxR}) {
      ranges.extrema.determined += is_proven ? 1 : 0;
      ranges.extrema.claim(contact, column) = is_proven ? Outcome::kEnclosed : Outcome::kFailed;
      ranges.enclosures.lower(contact, column) = lower;
      ranges.enclosures.upper(contact, column) = upper;
      ranges.enclosures.sensitivity.set(contact, column, {interval.sensitivity});
    }
    if (options.progress && !options.progress(++done, static_cast<std::int64_t>(forces.size())))
      throw Interrupted();
  }
}

}  // namespace indet
