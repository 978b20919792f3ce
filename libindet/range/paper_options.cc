#include "libindet/range/paper_options.h"

namespace indet {

const char* to_string(WalkStart start) {
  switch (start) {
    case WalkStart::kCommon:
      return "common";
    case WalkStart::kMinimum:
      return "minimum";
  }
  return "?";
}

}  // namespace indet
