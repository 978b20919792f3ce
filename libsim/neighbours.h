#pragma once

#include <span>
#include <vector>

#include "libsim/world.h"

namespace indet::sim {

/// Pairs of bodies, one of them free, that may touch (Verlet list from a hashed cell grid). Disk i's partners
/// are disks j > i in ascending order; walls likewise. The order depends on the positions alone, not on when
/// the list was made, so that a resumed run sums in the same order as an uninterrupted one.
///
/// A list made with reach d and skin s holds every pair whose gap is at most d + s, and stays complete for
/// gaps up to d until some disk has moved by s/2.
class NeighbourList {
 public:
  /// `skin` in the world's unit of length, > 0.
  explicit NeighbourList(double skin) : skin_(skin) {}

  /// Makes the list anew if it can no longer be complete for gaps up to `reach`. Returns true if it did.
  bool update(const World& world, double reach);

  /// Largest distance that a disk has moved since the list was made.
  double farthest_move(const World& world) const;

  /// Makes the list anew.
  void rebuild(const World& world, double reach);

  /// Disks j > i near disk i.
  std::span<const int> disks_near(int i) const {
    return {partners_.data() + first_[i], partners_.data() + first_[i + 1]};
  }
  /// Index of disk i's first partner among all pairs; size N + 1.
  const std::vector<int>& first() const { return first_; }
  const std::vector<int>& partners() const { return partners_; }

  /// Walls near disk i, in ascending order.
  std::span<const int> walls_near(int i) const {
    return {walls_.data() + first_wall_[i], walls_.data() + first_wall_[i + 1]};
  }
  const std::vector<int>& first_wall() const { return first_wall_; }
  const std::vector<int>& walls() const { return walls_; }

  double skin() const { return skin_; }
  /// For the lists that are made from now on.
  void set_skin(double skin) { skin_ = skin; }

 private:
  double skin_;
  double reach_ = -1;
  std::vector<double> built_x_, built_y_;
  std::vector<int> first_, partners_;
  std::vector<int> first_wall_, walls_;
  std::vector<int> bucket_first_, bucket_disks_, cell_x_, cell_y_, bucket_of_;  // reused between rebuilds
};

}  // namespace indet::sim
