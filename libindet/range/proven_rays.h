#pragma once

#include "libindet/exact/contact_problem.h"
#include "libindet/packing/packing.h"
#include "libindet/range/outcome.h"

namespace indet {

/// Proves each of these directions [Q, 2M] (ExtremalStates::rays) in rational arithmetic. True if all are
/// rays of ker c ∩ K near to which an exact one lies, with the same zeros.
///
/// Where normals are rounded, as in regular arrays, an extremal ray of the ideal geometry has no exact one
/// with its zeros: contacts that it leaves alone need a force of some 1e-16. Such a ray is moved a little
/// towards the sum of all, which has far fewer zeros, and stays a ray along which the same forces grow; after
/// some, one behind the other, that are not exact as they are, so is every further one. If
/// one is still not proven, forces that grow along it may be limited after all, and other values belong to
/// vertices far away.
bool prove_rays(const Packing& packing, const exact::ContactProblem& exact, Rows<double>& rays);

}  // namespace indet
