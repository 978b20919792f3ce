#include "libindet/range/proven_rays.h"

#include <map>
#include <span>
#include <vector>

#include "libindet/base/tolerances.h"
#include "libindet/exact/ray.h"
#include "libindet/range/pivot_preference.h"

namespace indet {
namespace {

/// In regular arrays no ray is exact as it is: after so many, one after the other, that are not, the rest is
/// moved at once.
constexpr int kMostInVain = 8;

}  // namespace

bool prove_rays(const Packing& packing, const exact::ContactProblem& exact, Rows<double>& rays) {
  if (rays.rows() == 0) return true;
  Eigen::VectorXd inner = rays.colwise().sum().transpose();
  inner /= inner.lpNorm<Eigen::Infinity>();
  const auto growths = [&](const Eigen::VectorXd& ray) {
    return exact::edge_growths(packing, std::span(ray.data(), static_cast<std::size_t>(ray.size())));
  };
  std::map<std::vector<int>, exact::RaysOnEdges> moved_to;  // most load the same edges
  int in_vain = 0;
  for (Eigen::Index q = 0; q < rays.rows(); ++q) {
    Eigen::VectorXd ray = rays.row(q).transpose();
    if (in_vain < kMostInVain) {
      const bool is_proven = exact::proves_ray(exact, growths(ray), tolerance::kExactZero);
      in_vain = is_proven ? 0 : in_vain + 1;
      if (is_proven) continue;
    }
    ray += tolerance::kInwardShift * inner;
    ray /= ray.lpNorm<Eigen::Infinity>();
    const std::vector<double> guess = growths(ray);
    std::vector<int> edges = exact::loaded_edges(exact, guess, tolerance::kExactZero);
    auto found = moved_to.find(edges);
    if (found == moved_to.end())
      found = moved_to.try_emplace(edges, exact, edges, pivot_preference(exact, edges)).first;
    if (!found->second.contain_one_near(guess)) return false;
    rays.row(q) = ray.transpose();
  }
  return true;
}

}  // namespace indet
