#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "apps/ensemble/members/checkpoint.h"
#include "apps/ensemble/members/limits_step.h"
#include "apps/ensemble/members/paper_walk_step.h"
#include "apps/ensemble/members/plan.h"
#include "apps/ensemble/members/uniform_step.h"
#include "libindet/base/progress.h"
#include "libindet/io/sampling_file.h"
#include "libindet/io/simulation_file.h"
#include "libindet/range/force_ranges.h"

namespace indet {

/// How often the normal force of a contact lies in [k, k + 1) mg in the extremal states, one row for each
/// objective (R_min, R_max, T_min, T_max): each of the M objectives of a kind contributes the M forces of its
/// state.
struct ExtremalForces {
  std::array<std::vector<std::int32_t>, 4> counts;
};

/// `vertex`: rows of `states`, which are in the scene's units.
ExtremalForces count_extremal_forces(const Rows<double>& states, const Table4<std::int32_t>& vertex,
                                     double force_unit);

/// Everything that was found about one packing.
struct MemberResult {
  Packing packing;
  std::optional<SimulationRecord> simulation;
  ForceRanges ranges;
  Eigen::VectorXd solver_d_R,
      solver_d_T;                  ///< [24] with the states that the solver happens to find; or empty.
  ExtremalForces extremal;         ///< Of the canonical states.
  ExtremalForces solver_extremal;  ///< Of the states that the solver happens to find; or empty.
  std::optional<SamplingRecord> sampling;
  std::optional<UniformResult> uniform;
  std::optional<PaperWalkResult> paper_walk;
  std::vector<Limit> limits;  ///< Of limits_step.h; empty if they were not asked for, or it has none.
  std::map<std::string, double> seconds;
};

/// Simulates (or takes `given`, the packing of a file), analyses and samples one packing, on the calling
/// thread. `first`: the cd1 packing that cd2 and md2 start from; where it is missing it is simulated. The
/// result is the same either way. Throws InputError or LibraryError if there is no packing with balanced
/// forces; Interrupted, after its simulation has left a checkpoint, from which the next call goes on.
MemberResult compute_member(const EnsembleConfig& config, const Member& member,
                            const std::optional<Packing>& given, const std::optional<Packing>& first,
                            const MemberCheckpoint& checkpoint, const ProgressCallback& progress);

}  // namespace indet
