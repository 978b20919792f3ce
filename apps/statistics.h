#pragma once

#include <Eigen/Core>
#include <cmath>

namespace indet::app {

/// Mean and largest of the values that are known: infinite where one of them is, NaN where none is known.
struct Statistics {
  double mean = std::nan("");
  double max = std::nan("");
};

inline Statistics statistics(const Eigen::VectorXd& values) {
  Statistics result;
  double sum = 0;
  int count = 0;
  for (const double value : values) {
    if (std::isnan(value)) continue;
    sum += value;
    ++count;
    if (!(result.max >= value)) result.max = value;
  }
  if (count > 0) result.mean = sum / count;
  return result;
}

}  // namespace indet::app
