#include "libindet/range/paper_work.h"

#include <numeric>

namespace indet {

PaperWork& PaperWork::operator+=(const PaperWork& other) {
  for (std::size_t i = 0; i < starts.size(); ++i) starts[i] += other.starts[i];
  for (std::size_t i = 0; i < walks.size(); ++i) walks[i] += other.walks[i];
  sliding_left += other.sliding_left;
  points += other.points;
  unexpected += other.unexpected;
  neighbours += other.neighbours;
  return *this;
}

std::int64_t PaperWork::walk_count() const {
  return std::accumulate(walks.begin(), walks.end(), std::int64_t{0});
}

std::int64_t PaperWork::failures() const {
  return walk_count() - walks[static_cast<std::size_t>(WalkEnd::kNoneBetter)];
}

std::int64_t PaperWork::fallbacks() const {
  return std::accumulate(starts.begin(), starts.end(), std::int64_t{0}) -
         starts[static_cast<std::size_t>(InteriorEnd::kFound)];
}

}  // namespace indet
