#include "libindet/range/result_fields.h"

#include <cmath>

namespace indet {

const char* to_string(Extent extent) {
  switch (extent) {
    case Extent::kOne:
      return "1";
    case Extent::kDirections:
      return "2";
    case Extent::kComponents:
      return "3";
    case Extent::kColumns:
      return "4";
    case Extent::kDisks:
      return "N";
    case Extent::kWalls:
      return "W";
    case Extent::kContacts:
      return "M";
    case Extent::kForces:
      return "2M";
    case Extent::kStates:
      return "K";
    case Extent::kRays:
      return "Q";
    case Extent::kActive:
      return "d";
    case Extent::kBounds:
      return "B";
    case Extent::kStateContacts:
      return "C";
    case Extent::kDualContacts:
      return "D";
    case Extent::kDualValues:
      return "4D";
    case Extent::kSceneRows:
      return "Y";
    case Extent::kReactions:
      return "P";
    case Extent::kEnds:
      return "2";
    case Extent::kReactionStates:
      return "S";
    case Extent::kReactionRays:
      return "U";
  }
  return "?";
}

bool is_present(Presence presence, const ForceRanges& ranges, std::int64_t row_count) {
  switch (presence) {
    case Presence::kAlways:
      return true;
    case Presence::kSubset:
      return ranges.choice != ContactChoice::Kind::kAll;
    case Presence::kSample:
      return ranges.choice == ContactChoice::Kind::kSample;
    case Presence::kDrawn:
      return ranges.draws > 0;
    case Presence::kSeed:
      return ranges.sample_seed >= 0;
    case Presence::kEstimate:
      return ranges.calibration >= 0;
    case Presence::kPaper:
      return ranges.method == Method::kPivotingPaper;
    case Presence::kInterval:
      return !std::isnan(ranges.gap);
    case Presence::kDuals:
      return ranges.duals.are_kept();
    case Presence::kReason:
      return !ranges.reason.empty();
    case Presence::kExact:
      return ranges.exact;
    case Presence::kHairline:
      return !std::isnan(ranges.hairline);
    case Presence::kUnknownBlocks:
      return !ranges.blocks_reason.empty();
    case Presence::kRandom:
      return ranges.method == Method::kPivotingPaper &&
             ranges.paper_options.neighbour == NeighbourRule::kRandom;
    case Presence::kWhereRows:
      return row_count > 0;
  }
  return true;
}

}  // namespace indet
