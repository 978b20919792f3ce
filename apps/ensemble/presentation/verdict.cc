#include "apps/ensemble/presentation/verdict.h"

#include <algorithm>
#include <cmath>

namespace indet {

const char* verdict(const Estimate& ours, double paper, double paper_error) {
  if (std::isnan(ours.value) || std::isnan(ours.error)) return kNotDecided;
  return verdict_of(std::abs(ours.value - paper) <= 2 * std::hypot(ours.error, paper_error));
}

const char* verdict_of_order(const Estimate& large, const Estimate& small) {
  const double difference = large.value - small.value;
  const double error = std::hypot(large.error, small.error);
  if (difference > 2 * error) return kAgrees;
  return difference < -2 * error ? kDiffers : kNotDecided;
}

const char* verdict_about(const Estimate& ours, double paper) {
  const double difference = std::abs(ours.value - paper);
  const double reach = std::max(0.1 * paper, 2 * ours.error);
  if (difference > reach) return kDiffers;
  return reach <= 0.5 * paper ? kAgrees : kNotDecided;
}

}  // namespace indet
