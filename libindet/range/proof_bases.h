#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "libindet/lp/vertex.h"
#include "libindet/polytope/force_polytope.h"
#include "libindet/range/extrema.h"

namespace indet {

/// A basis as the vertex that it defines, with its factors.
struct ProofBasis {
  std::size_t block = 0;
  Vertex vertex;
};

/// Visits each distinct basis of `proofs` once, with the numbers of the proofs that name it. Factors are d ×
/// d, so that only those of one basis are held at a time. Throws LibraryError if a basis is singular.
void for_each_basis(
    const ForcePolytope& polytope, const std::vector<OptimalBasis>& proofs,
    const std::function<void(const ProofBasis& basis, std::span<const std::size_t> proofs)>& visit);

}  // namespace indet
