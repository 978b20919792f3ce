#include "libindet/verify/hull_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "libindet/base/tolerances.h"
#include "libindet/verify/affine_hull.h"
#include "libindet/verify/free_directions.h"

namespace indet {
namespace {

/// What is found of F again, as far as it is clear.
struct Found {
  std::optional<int> blocks;
  std::optional<std::vector<bool>> varies;  ///< of each component of the forces
  const char* reason = "";                  ///< why something is missing
};

std::optional<AffineHull> hull_of_states(const ForceRanges& ranges, const RebuiltProblem& problem) {
  if (ranges.states.rows() == 0) return std::nullopt;
  Eigen::VectorXd inside = ranges.states.colwise().mean().transpose() / ranges.force_unit;
  if (ranges.rays.rows() > 0) inside += ranges.rays.colwise().sum().transpose();
  return AffineHull::at(problem, inside);
}

std::optional<std::vector<bool>> varying(const AffineHull& hull, int components) {
  if (!hull.freedom_is_clear()) return std::nullopt;
  std::vector<bool> result;
  for (int k = 0; k < components; ++k) result.push_back(hull.freedom(k) > tolerance::kDeterminedForce);
  return result;
}

Found find_again(const Packing& packing, const ForceRanges& ranges, const RebuiltProblem& problem,
                 Comparisons& compare) {
  Found found;
  const bool is_small = ranges.unknowns <= tolerance::kMostForPrograms;
  const std::optional<AffineHull> hull = is_small ? hull_of_states(ranges, problem) : std::nullopt;
  if (hull) {
    compare.require(hull->dim() <= ranges.dim, "dim: {} is stored, but the states span {} dimensions",
                    ranges.dim, hull->dim());
  }
  if (hull && hull->dim() == ranges.dim) {
    found.blocks = hull->blocks();
    found.varies = varying(*hull, 2 * packing.contact_count());
    found.reason = "rounding hides them";
    return found;
  }
  const auto free = FreeDirections::of(problem, packing, ranges);
  if (free) {
    found.blocks = free->blocks();
    found.varies = free->varying();
  }
  found.reason =
      free ? "rounding hides them" : "the file does not tell clearly which edges are closed in all states";
  return found;
}

}  // namespace

void check_hull(const Packing& packing, const ForceRanges& ranges, const RebuiltProblem& problem,
                Comparisons& compare) {
  if (ranges.status == PolytopeStatus::kEmpty) {
    compare.equal_count(ranges.dim, -1, "dim");
    compare.equal_count(ranges.blocks, 0, "blocks");
    compare.equal_count(ranges.determined, 0, "determined");
    return;
  }
  const Found found = find_again(packing, ranges, problem, compare);
  if (ranges.blocks < 0) {
    compare.leave_unchecked("blocks (the analysis does not tell how many there are)");
  } else if (found.blocks) {
    compare.equal_count(ranges.blocks, *found.blocks, "blocks");
  } else {
    compare.leave_unchecked(fmt::format("blocks ({})", found.reason));
  }
  if (!found.varies) {
    compare.leave_unchecked(fmt::format("determined ({})", found.reason));
    return;
  }
  std::int64_t determined = 0;
  for (Eigen::Index i = 0; i < packing.contact_count(); ++i) {
    if (ranges.outcome(i, kMinR) == Outcome::kNotRequested) continue;
    for (const bool tangential : {false, true}) {
      const auto k = static_cast<std::size_t>(2 * i + (tangential ? 1 : 0));
      determined += !(*found.varies)[k] ? 2 : 0;
    }
  }
  // The barrier method counts those that it proves.
  if (ranges.method == Method::kBarrier) {
    compare.require(ranges.determined >= 0 && ranges.determined <= determined,
                    "determined: {} is stored, at most {} is right", ranges.determined, determined);
  } else {
    compare.equal_count(ranges.determined, determined, "determined");
  }
}

}  // namespace indet
