#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "libindet/packing/packing.h"
#include "libindet/range/force_ranges.h"
#include "tests/support/field_rules.h"

namespace indet::test {

/// The same packing seen otherwise, and what its results must be.
struct View {
  std::string name;
  Packing packing;
  std::function<ForceRanges(const ForceRanges&)> mapped;  ///< the results of the packing, seen so
  Nearness nearness;                                      ///< but for the tolerance
  bool keeps_reactions = true;
  /// Tolerances of the barrier method are relative to at least the unit of force: with another it may find no
  /// centre, and linear programs answer in its place.
  bool keeps_method = true;
};

/// A pile by chance (zoo::random_pile) of 6 to 11 disks: with friction of each contact of its own or the
/// same, with loads and torques, with a fixed disk, with a named unit; and of every second one the forces of
/// an extremal state as those of a simulation.
Packing random_scene(std::uint64_t seed);

/// In other order, with the bodies of contacts swapped, mirrored, turned, shifted by 1e6, in other lengths,
/// masses, accelerations and units, with a wall twice, with a loose disk.
std::vector<View> views_of(const Packing& packing, std::uint64_t seed);

/// Analyses the scenes of these seeds in every view, by linear programs, by the barrier method with duals,
/// and for estimates; and compares every field by its rule. `told`: the fields that had something to say.
struct Comparisons {
  int made = 0;
  int by_another_method = 0;  ///< left out, as the view changed the method
};
Comparisons compare_views(std::uint64_t first_seed, std::uint64_t last_seed, std::set<std::string>& told);

}  // namespace indet::test
