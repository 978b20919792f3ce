#include "libindet/range/method.h"

namespace indet {

const char* to_string(Method method) {
  switch (method) {
    case Method::kLp:
      return "lp";
    case Method::kPivotingPaper:
      return "pivoting-paper";
    case Method::kPivotingTableau:
      return "pivoting-tableau";
    case Method::kBarrier:
      return "barrier";
  }
  return "?";
}

}  // namespace indet
