#include "libindet/range/barrier_analysis.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "libindet/base/stopwatch.h"
#include "libindet/range/central_states.h"
#include "libindet/range/distance_search.h"

namespace indet {
namespace {

/// Unknowns up to which linear programs take seconds.
constexpr int kMostForSecondSearch = 1000;

/// Whether values of an unbounded F came out too wide, as that of a force which only the exact equations keep
/// from growing along a ray, in a packing for which linear programs soon find all.
bool is_left_to_programs(const Packing& packing, const ForcePolytope& polytope, const BarrierRanges& found) {
  if (!may_be_left_to_programs(polytope)) return false;
  for (Eigen::Index i = 0; i < packing.contact_count(); ++i) {
    for (int column = 0; column < 4; ++column) {
      if (found.extrema.claim(i, column) != Outcome::kEnclosed) continue;
      const EnclosedValue value =
          enclosed_value(found.enclosures.lower(i, column), found.enclosures.upper(i, column),
                         found.extrema.gap, polytope.problem.units.weight_in_scene());
      if (value.outcome != Outcome::kEnclosed) return true;
    }
  }
  return found.reactions.uncertain() > 0;
}

/// Of the contacts whose states are kept, those of a part.
StateChoice of_part(StateChoice kept, const std::vector<int>& contacts) {
  if (kept.contacts == StateChoice::Contacts::kList) {
    std::erase_if(kept.list, [&](int contact) {
      return !std::binary_search(contacts.begin(), contacts.end(), contact);
    });
  }
  return kept;
}

}  // namespace

BarrierAnalysis::BarrierAnalysis(const Packing& packing, const AnalysisStart& start,
                                 const std::vector<int>& contacts, const CentralWidths& widths,
                                 const AnalyzeOptions& options)
    : packing_(packing),
      start_(start),
      gap_(options.gap),
      smallest_distances_(options.smallest_distances),
      prepared_(prepare_barrier_ranges(
          packing, start.polytope, contacts, widths, options.reactions,
          interval_options(options.gap, options.threads, options.progress, "force ranges"), options.duals)) {}

std::optional<ForceRanges> BarrierAnalysis::find(const std::vector<int>& contacts,
                                                 const ContactRequest& request, int threads,
                                                 const ProgressCallback& progress) const {
  const ForcePolytope& polytope = start_.polytope;
  const auto stage = [&](const char* name) { return interval_options(gap_, threads, progress, name); };
  std::map<std::string, double> seconds;
  StageTimes times(seconds);
  BarrierRanges found = find_barrier_ranges(packing_, polytope, prepared_, contacts, stage("force ranges"));
  times.mark("ranges");
  if (is_left_to_programs(packing_, polytope, found)) return {};
  found.extrema.reason = start_.choice.reason;
  add_states(contacts, stage("extremal states"), found);
  times.mark("states");
  ForceRanges ranges =
      assemble(packing_, summarise(packing_, polytope), request, found.extrema, found.enclosures);
  ranges.reactions = std::move(found.reactions);
  ranges.duals = std::move(found.duals);
  times.mark("measures");
  if (smallest_distances_) {
    ranges.smallest = find_smallest_distances(polytope, ranges, contacts, stage("smallest distances"));
    times.mark("smallest distances");
  }
  ranges.seconds = std::move(seconds);
  return ranges;
}

/// The states that are to be kept, where the method has any.
void BarrierAnalysis::add_states(const std::vector<int>& contacts, const IntervalOptions& options,
                                 BarrierRanges& found) const {
  const ForcePolytope& polytope = start_.polytope;
  const StateChoice kept = of_part(start_.kept, contacts);
  if (kept.kind == StateChoice::Kind::kNone || polytope.status == PolytopeStatus::kEmpty) return;
  if (!polytope.central) {
    found.extrema.reason =
        "forces are unbounded, for which this method has no extremal states, and the packing is too large "
        "for lp";
    return;
  }
  const Enclosures& enclosures = found.enclosures;
  const Table4<double> middles = enclosures.lower + (enclosures.upper - enclosures.lower) / 2;
  add_canonical_states(packing_, polytope, kept,
                       kept.keeps_all() ? contacts : contacts_with_states(kept, middles), options, found);
}

bool may_be_left_to_programs(const ForcePolytope& polytope) {
  return polytope.unbounded && polytope.natural.unknowns() <= kMostForSecondSearch;
}

}  // namespace indet
