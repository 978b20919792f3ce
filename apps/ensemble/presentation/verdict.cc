#include "apps/ensemble/presentation/verdict.h"

#include <algorithm>
#include <cmath>

namespace indet {

namespace {

/// Two standard errors that are more than this share of a number decide nothing about it.
constexpr double kLargestShare = 1.0 / 3;

const char* verdict_within(double difference, double reach, double paper) {
  if (difference > reach) return kDiffers;
  return reach <= kLargestShare * std::abs(paper) ? kAgrees : kNotDecided;
}

}  // namespace

const char* verdict(const Estimate& ours, double paper, double paper_error) {
  if (std::isnan(ours.value) || std::isnan(ours.error)) return kNotDecided;
  return verdict_within(std::abs(ours.value - paper), 2 * std::hypot(ours.error, paper_error), paper);
}

const char* verdict_of_order(const Estimate& large, const Estimate& small) {
  const double difference = large.value - small.value;
  const double error = std::hypot(large.error, small.error);
  if (difference > 2 * error) return kAgrees;
  return difference < -2 * error ? kDiffers : kNotDecided;
}

const char* verdict_about(const Estimate& ours, double paper) {
  return verdict_within(std::abs(ours.value - paper), std::max(0.1 * paper, 2 * ours.error), paper);
}

}  // namespace indet
