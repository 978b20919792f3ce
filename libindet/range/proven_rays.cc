#include "libindet/range/proven_rays.h"

#include <span>

#include "libindet/base/tolerances.h"
#include "libindet/exact/certificate.h"

namespace indet {
namespace {

bool is_proven(const Packing& packing, const exact::ContactProblem& exact, const Eigen::VectorXd& ray) {
  const std::span<const double> forces(ray.data(), static_cast<std::size_t>(ray.size()));
  return exact::proves_ray(exact, exact::edge_growths(packing, forces), tolerance::kExactZero);
}

}  // namespace

bool prove_rays(const Packing& packing, const exact::ContactProblem& exact, Rows<double>& rays) {
  if (rays.rows() == 0) return true;
  Eigen::VectorXd inner = rays.colwise().sum().transpose();
  inner /= inner.lpNorm<Eigen::Infinity>();
  bool all = true;
  for (Eigen::Index q = 0; all && q < rays.rows(); ++q) {
    Eigen::VectorXd ray = rays.row(q).transpose();
    if (is_proven(packing, exact, ray)) continue;
    ray += tolerance::kInwardShift * inner;
    ray /= ray.lpNorm<Eigen::Infinity>();
    all = is_proven(packing, exact, ray);
    if (all) rays.row(q) = ray.transpose();
  }
  return all;
}

}  // namespace indet
