#include "libsim/memory_estimate.h"

#include <Eigen/SparseCore>

#include "libindet/packing/packing.h"
#include "libsim/contact_solver.h"
#include "libsim/world.h"

namespace indet::sim {

std::size_t memory_estimate(std::int64_t disks) {
  constexpr double kContacts = 2;    // a disk at rest
  constexpr double kCandidates = 3;  // pairs near enough to touch, and walls

  constexpr double kWorld = sizeof(std::int32_t) + 12 * sizeof(double);
  constexpr double kWorlds = 4 * kWorld;  // start, stepper, checkpoint, before the start
  constexpr double kPackings = 2 * (sizeof(Disk) + kContacts * sizeof(Contact));
  constexpr double kNeighbours = 2 * sizeof(double) + (8 + kCandidates) * sizeof(int);
  constexpr double kStepper =
      2 * sizeof(SolverBody) + kCandidates * (2 * sizeof(SolverContact) + 3 * sizeof(ContactState));

  // The matrix of the polish has 10 entries a contact; its product with itself a block of 3 × 3 for each disk
  // and twice for each contact, and its factor about twice as many.
  constexpr double kEntry = sizeof(double) + sizeof(int);
  constexpr double kMatrix = 10 * kContacts * (sizeof(Eigen::Triplet<double>) + 2 * kEntry);
  constexpr double kProduct = 9 * (1 + 2 * kContacts) * kEntry;
  constexpr double kPolish = kMatrix + 3 * kProduct + 2 * kProduct;

  constexpr double kDisk = kWorlds + kPackings + kNeighbours + kStepper + kPolish;
  return static_cast<std::size_t>(kDisk * static_cast<double>(disks));
}

}  // namespace indet::sim
