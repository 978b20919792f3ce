#pragma once

#include <cstddef>
#include <cstdint>

namespace indet::sim {

/// Bytes that simulate() takes at its peak, the polish of a packing that came to rest, for so many disks:
/// what the states, the stepper, the packings and the sparse matrices of the polish hold. A disk at rest has
/// about two contacts; measured were 6 kB a disk there, and 9 kB with 2.8 contacts a disk.
std::size_t memory_estimate(std::int64_t disks);

}  // namespace indet::sim
