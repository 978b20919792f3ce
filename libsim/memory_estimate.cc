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

  // The upper half of the normal matrix of the polish has a triangle for each disk and a block of 3 × 3 for
  // each contact; it is filled from triplets, and its factor has about four times as many entries.
  constexpr double kEntry = sizeof(double) + sizeof(int);
  constexpr double kHalf = 6 + 9 * kContacts;
  constexpr double kLinks = kContacts * 20 * sizeof(double);
  constexpr double kPolish = kLinks + kHalf * (sizeof(Eigen::Triplet<double>) + (2 + 4) * kEntry);

  constexpr double kDisk = kWorlds + kPackings + kNeighbours + kStepper + kPolish;
  return static_cast<std::size_t>(kDisk * static_cast<double>(disks));
}

}  // namespace indet::sim
