#include "libindet/range/estimated_ranges.h"

#include <utility>
#include <vector>

#include "libindet/range/barrier_ranges.h"
#include "libindet/range/contact_choice.h"
#include "libindet/range/determined_forces.h"
#include "libindet/range/predicted_deltas.h"

namespace indet {

ForceRanges estimate_ranges(const Packing& packing, const ForcePolytope& polytope,
                            const EstimateOptions& estimate, const IntervalOptions& options) {
  ContactRequest request;
  static_cast<CentralWidths&>(request) = central_widths(polytope);
  request.choice = ContactChoice::Kind::kCalibration;
  if (estimate.calibration > 0) request.sample_seed = static_cast<std::int64_t>(estimate.seed);
  const Eigen::Index count = request.width.rows();
  std::vector<int> variable;
  for (Eigen::Index i = 0; i < count; ++i) {
    if (!is_determined(packing, request, i, false) || !is_determined(packing, request, i, true))
      variable.push_back(static_cast<int>(i));
  }
  const std::vector<int> contacts =
      draw_without_replacement(std::move(variable), estimate.calibration, estimate.seed);
  request.requested = static_cast<int>(contacts.size());
  Eigen::Array<std::uint8_t, Eigen::Dynamic, 1> calibrates;
  calibrates.setZero(count);
  for (const int i : contacts) calibrates[i] = 1;

  BarrierRanges found = find_barrier_ranges(packing, polytope, contacts, request, false, options);
  enclose_determined(packing, polytope, request, options, found);
  for (Outcome& claim : found.extrema.claim.reshaped()) {
    if (claim == Outcome::kNotRequested) claim = Outcome::kEstimate;
  }
  ForceRanges ranges =
      assemble(packing, summarise(packing, polytope), request, found.extrema, found.enclosures);
  static_cast<Estimates&>(ranges) = predict_deltas(packing, ranges, estimate, calibrates);
  return ranges;
}

}  // namespace indet
