#include "libindet/limit/limit.h"

#include <utility>

#include "libindet/limit/tilt.h"

namespace indet {

const char* to_string(LimitKind kind) { return kind == LimitKind::kTilt ? "tilt" : "load"; }

Limit find_tilt(const Packing& packing, const LimitOptions& options) {
  TiltLimits found = find_tilt_limits(packing, options);
  Limit limit;
  limit.kind = LimitKind::kTilt;
  limit.load = "tilt";
  limit.smallest = std::move(found.smallest);
  limit.largest = std::move(found.largest);
  limit.is_first_of_several = found.is_first_of_several;
  return limit;
}

Limit find_load(const Packing& packing, std::string name, Loads change, const LimitOptions& options) {
  LoadLimits found = find_load_limits(packing, change, options);
  Limit limit;
  limit.kind = LimitKind::kLoad;
  limit.load = std::move(name);
  limit.change = std::move(change);
  limit.smallest = std::move(found.smallest);
  limit.largest = std::move(found.largest);
  return limit;
}

Packing at_end(const Packing& packing, const Limit& limit, const LimitEnd& end) {
  if (limit.kind == LimitKind::kLoad) return under(limit.change, end.value, packing);
  Packing tilted = packing;
  tilted.gravity = turned_gravity(packing, end.value);
  return tilted;
}

}  // namespace indet
