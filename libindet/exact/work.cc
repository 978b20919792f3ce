#include "libindet/exact/work.h"

#include <algorithm>
#include <cmath>

namespace indet::exact {

Work::Work(const ContactProblem& problem, double limit)
    : solve_(1e3 + std::pow(static_cast<double>(problem.rows()), 2)), limit_(limit) {}

int Work::pivots() const {
  constexpr double kLongestWalk = 10000;
  return static_cast<int>(std::clamp((limit_ - done_) / solve_, 0.0, kLongestWalk));
}

}  // namespace indet::exact
