#include "libindet/range/outcome.h"

namespace indet {

const char* to_string(Outcome outcome) {
  switch (outcome) {
    case Outcome::kOptimal:
      return "optimal";
    case Outcome::kUnbounded:
      return "unbounded";
    case Outcome::kImprecise:
      return "imprecise";
    case Outcome::kFailed:
      return "failed";
    case Outcome::kNotRequested:
      return "not requested";
    case Outcome::kEnclosed:
      return "enclosed";
    case Outcome::kEstimate:
      return "estimate";
  }
  return "?";
}

const char* to_string(Column column) {
  switch (column) {
    case kMinR:
      return "R_min";
    case kMaxR:
      return "R_max";
    case kMinT:
      return "T_min";
    case kMaxT:
      return "T_max";
  }
  return "?";
}

}  // namespace indet
