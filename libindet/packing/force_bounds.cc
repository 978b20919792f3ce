#include "libindet/packing/force_bounds.h"

#include <fmt/format.h>

#include <cmath>

namespace indet {

std::vector<ForceBound> force_bounds(const Packing& packing) {
  std::vector<ForceBound> bounds;
  const auto add = [&](ContactId contact, bool tangential, double lo, double hi) {
    using Side = ForceBound::Side;
    if (lo == hi) {
      bounds.push_back({contact, tangential, Side::kEqual, lo});
      return;
    }
    if (lo > -std::numeric_limits<double>::infinity())
      bounds.push_back({contact, tangential, Side::kLower, lo, hi});
    if (hi < std::numeric_limits<double>::infinity())
      bounds.push_back({contact, tangential, Side::kUpper, hi, lo});
  };
  for (int i = 0; i < packing.contact_count(); ++i) {
    const Contact& contact = packing[ContactId(i)];
    const double none = -std::numeric_limits<double>::infinity();
    const double least = contact.R_hi == 0 ? 0 : none;
    add(ContactId(i), false, contact.R_lo > 0 ? contact.R_lo : least, contact.R_hi);
    const bool is_zero = contact.mu == 0 && contact.T_lo <= 0 && contact.T_hi >= 0;
    if (!is_zero) add(ContactId(i), true, contact.T_lo, contact.T_hi);
  }
  int next = 2 * packing.contact_count();
  for (ForceBound& bound : bounds) {
    if (bound.side != ForceBound::Side::kEqual) bound.half_plane = next++;
  }
  return bounds;
}

double slack(const ForceBound& bound, const Eigen::VectorXd& forces, double unit) {
  const double beyond = forces[bound.component()] - bound.value / unit;
  if (bound.side == ForceBound::Side::kEqual) return -std::abs(beyond);
  return bound.side == ForceBound::Side::kLower ? beyond : -beyond;
}

std::string bound_name(const Packing& packing, const ForceBound& bound, double unit) {
  const char* sign = bound.side == ForceBound::Side::kLower   ? "≥"
                     : bound.side == ForceBound::Side::kUpper ? "≤"
                                                              : "=";
  return fmt::format("{} of contact {} ({}) {} {:.6g}", bound.tangential ? "T" : "R", bound.contact.value(),
                     contact_name(packing, bound.contact), sign, bound.value / unit);
}

}  // namespace indet
