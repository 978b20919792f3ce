#include "libindet/range/proof_bases.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace indet {

void for_each_basis(
    const ForcePolytope& polytope, const std::vector<OptimalBasis>& proofs,
    const std::function<void(const ProofBasis& basis, std::span<const std::size_t> proofs)>& visit) {
  const auto key = [&](std::size_t k) { return std::tie(proofs[k].block, proofs[k].basis); };
  std::vector<std::size_t> order(proofs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  for (std::size_t first = 0; first < order.size();) {
    std::size_t last = first;
    while (last < order.size() && key(order[last]) == key(order[first])) ++last;
    const OptimalBasis& proof = proofs[order[first]];
    visit({proof.block, locate_vertex(polytope.blocks[proof.block].view, proof.basis)},
          std::span(order).subspan(first, last - first));
    first = last;
  }
}

}  // namespace indet
