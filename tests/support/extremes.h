#pragma once

#include <gmpxx.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "libindet/packing/packing.h"
#include "libindet/range/force_ranges.h"

namespace indet::extremes {

/// A scene at the edge of what double precision can tell, small enough for exact arithmetic.
struct Scene {
  std::string kind;  ///< a row of the table
  std::string name;
  Packing packing;
};

/// Several hundred scenes, always the same: near-coincident contacts, critical friction, friction
/// coefficients, masses, radii and units over many decades, perfect and jittered lattices, columns, arches,
/// sliding and idle contacts, hairlines between empty and not, clusters, redundant walls, next to nothing.
std::vector<Scene> fixed_scenes();

/// Scene number `seed` of an endless row: a pile of up to `most` disks with one or two of its numbers driven
/// to an extreme.
Scene random_scene(std::uint64_t seed, int most);

/// What became of the results of a scene, beside the exact answer of RationalSimplex. One count an objective,
/// or one for a scene that is empty.
struct Tally {
  std::int64_t right = 0;      ///< unmarked, and within 1e-9 max(|exact|, mg) of the exact value
  std::int64_t contained = 0;  ///< unmarked, farther off, but the enclosure contains the exact value
  std::int64_t marked = 0;     ///< imprecise, failed, or a decision declared doubtful
  std::int64_t wrong = 0;      ///< none of these, or an enclosure without the exact value: must be 0
  std::vector<std::string> complaints;

  void add(const Tally& other);
};

/// Knows the exact answers to a scene.
class Judge {
 public:
  explicit Judge(const Scene& scene);
  Tally judge(const ForceRanges& ranges) const;

 private:
  std::string name_;
  mpq_class unit_;
  bool empty_ = false;
  int rank_ = 0;
  /// Of each contact, by Column; nothing: unbounded.
  std::vector<std::array<std::optional<mpq_class>, 4>> values_;
};

Tally judge(const Scene& scene, const ForceRanges& ranges);

}  // namespace indet::extremes
