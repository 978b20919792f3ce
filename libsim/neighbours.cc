#include "libsim/neighbours.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace indet::sim {
namespace {

std::uint32_t hash_cell(int cx, int cy) {
  return static_cast<std::uint32_t>(cx) * 73856093u ^ static_cast<std::uint32_t>(cy) * 19349663u;
}

/// Cell coordinate; far-away disks share the outermost cells, which only costs time.
int cell_of(double position, double size) {
  return static_cast<int>(std::clamp(std::floor(position / size), -1e9, 1e9));
}

}  // namespace

double NeighbourList::farthest_move(const World& world) const {
  double farthest = 0;
  for (int i = 0; i < world.size(); ++i) {
    const double dx = world.x[i] - built_x_[i];
    const double dy = world.y[i] - built_y_[i];
    farthest = std::max(farthest, dx * dx + dy * dy);
  }
  return std::sqrt(farthest);
}

bool NeighbourList::update(const World& world, double reach) {
  const bool complete = reach <= reach_ && static_cast<int>(built_x_.size()) == world.size() &&
                        farthest_move(world) <= skin_ / 2;
  if (!complete) rebuild(world, reach);
  return !complete;
}

void NeighbourList::rebuild(const World& world, double reach) {
  const int n = world.size();
  reach_ = reach;
  built_x_ = world.x;
  built_y_ = world.y;
  const double range = reach + skin_;
  double largest = 0;
  for (const double r : world.radius) largest = std::max(largest, r);
  const double cell = 2 * largest + range;

  // Disks by bucket of their cell's hash, in ascending order within a bucket.
  const auto buckets = std::bit_ceil(static_cast<std::uint32_t>(std::max(16, 2 * n)));
  const std::uint32_t mask = buckets - 1;
  bucket_first_.assign(buckets + 1, 0);
  cell_x_.resize(n);
  cell_y_.resize(n);
  bucket_of_.resize(n);
  for (int i = 0; i < n; ++i) {
    cell_x_[i] = cell_of(world.x[i], cell);
    cell_y_[i] = cell_of(world.y[i], cell);
    bucket_of_[i] = static_cast<int>(hash_cell(cell_x_[i], cell_y_[i]) & mask);
    ++bucket_first_[bucket_of_[i] + 1];
  }
  for (std::uint32_t b = 0; b < buckets; ++b) bucket_first_[b + 1] += bucket_first_[b];
  bucket_disks_.resize(n);
  for (int i = n - 1; i >= 0; --i) {
    // Filled from the back of each bucket: the running end of bucket b is the start of bucket b + 1.
    bucket_disks_[--bucket_first_[bucket_of_[i] + 1]] = i;
  }
  // Now bucket_first_[b + 1] is the start of bucket b; its end is the start of the next.
  first_.assign(1, 0);
  partners_.clear();
  first_wall_.assign(1, 0);
  walls_.clear();
  for (int i = 0; i < n; ++i) {
    const auto begin = static_cast<std::ptrdiff_t>(partners_.size());
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const int cx = cell_x_[i] + dx;
        const int cy = cell_y_[i] + dy;
        const std::uint32_t bucket = hash_cell(cx, cy) & mask;
        const int end = bucket + 1 < buckets ? bucket_first_[bucket + 2] : n;
        for (int k = bucket_first_[bucket + 1]; k < end; ++k) {
          const int j = bucket_disks_[k];
          if (j <= i || cell_x_[j] != cx || cell_y_[j] != cy) continue;
          if (world.fixed[i] && world.fixed[j]) continue;
          const double ex = world.x[i] - world.x[j];
          const double ey = world.y[i] - world.y[j];
          const double distance = world.radius[i] + world.radius[j] + range;
          if (ex * ex + ey * ey <= distance * distance) partners_.push_back(j);
        }
      }
    }
    std::sort(partners_.begin() + begin, partners_.end());
    first_.push_back(static_cast<int>(partners_.size()));
    for (int w = 0; w < static_cast<int>(world.walls.size()) && !world.fixed[i]; ++w) {
      const Wall& wall = world.walls[w];
      const double height =
          (world.x[i] - wall.point.x()) * wall.normal.x() + (world.y[i] - wall.point.y()) * wall.normal.y();
      if (height <= world.radius[i] + range) walls_.push_back(w);
    }
    first_wall_.push_back(static_cast<int>(walls_.size()));
  }
}

}  // namespace indet::sim
