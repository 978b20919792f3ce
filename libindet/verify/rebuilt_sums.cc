#include "libindet/verify/rebuilt_sums.h"

#include <cmath>
#include <utility>

namespace indet {
namespace {

/// Contact by contact, what a sum adds: (of R, of T).
Vector2 share_of(const Packing& packing, const Contact& contact, Body body, int component) {
  const bool is_a = !body.is_wall() && contact.a == body.disk_id();
  if (!is_a && contact.b != body) return {0, 0};
  Vector2 share(0, 0);
  if (body.is_wall()) {
    share[component] = 1;
  } else if (component == 2) {
    const double lever = is_a ? contact.lever_a : contact.lever_b;
    share.y() = std::isnan(lever) ? packing[body.disk_id()].radius : lever;
  } else {
    const Vector2 tangent(contact.normal.y(), -contact.normal.x());
    share = Vector2(contact.normal[component], tangent[component]) * (is_a ? 1 : -1);
  }
  if (contact.mu == 0) share.y() = 0;
  return share;
}

}  // namespace

std::vector<RebuiltSum> rebuilt_sums(const Packing& packing) {
  std::vector<RebuiltSum> sums;
  const auto add = [&](Body body, int components) {
    for (int k = 0; k < components; ++k) {
      RebuiltSum sum{body, k, Eigen::VectorXd(2 * packing.contact_count())};
      for (int i = 0; i < packing.contact_count(); ++i)
        sum.coefficients.segment<2>(2 * i) = share_of(packing, packing[ContactId(i)], body, k);
      if (sum.coefficients.size() > 0 && sum.coefficients.cwiseAbs().maxCoeff() > 0)
        sums.push_back(std::move(sum));
    }
  };
  for (int w = 0; w < packing.wall_count(); ++w) add(Body::wall(WallId(w)), 2);
  for (int i = 0; i < packing.disk_count(); ++i) {
    if (packing[DiskId(i)].fixed) add(Body::disk(DiskId(i)), 3);
  }
  return sums;
}

}  // namespace indet
