#include "libindet/range/contact_choice.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <numeric>

#include "libindet/base/random.h"

namespace indet {

namespace {

/// W of W + γ W²/3 + γ² W³/27 + γ/6K = u, in a form that loses no digits for small γ.
double invert_hall(double u, double skewness, double count) {
  const double shifted = u - skewness / (6 * count);
  const double root = std::cbrt(1 + skewness * shifted);
  return 3 * shifted / (root * root + root + 1);
}

}  // namespace

const char* to_string(ContactChoice::Kind kind) {
  switch (kind) {
    case ContactChoice::Kind::kAll:
      return "all";
    case ContactChoice::Kind::kSample:
      return "sample";
    case ContactChoice::Kind::kList:
      return "list";
  }
  return "?";
}

std::vector<int> chosen_contacts(const ContactChoice& choice, int contacts) {
  std::vector<int> chosen = choice.list;
  if (choice.kind != ContactChoice::Kind::kList) {
    chosen.resize(static_cast<std::size_t>(contacts));
    std::iota(chosen.begin(), chosen.end(), 0);
  }
  if (choice.kind == ContactChoice::Kind::kSample) {
    const auto size = static_cast<std::size_t>(std::min(choice.sample_size, contacts));
    Random random(choice.seed);
    for (std::size_t i = 0; i < size; ++i) std::swap(chosen[i], chosen[i + random.below(chosen.size() - i)]);
    chosen.resize(size);
  }
  std::sort(chosen.begin(), chosen.end());
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  return chosen;
}

SampleEstimate estimate_from_sample(const std::vector<double>& values, int population) {
  const auto count = static_cast<double>(values.size());
  const double fraction = count / population;
  SampleEstimate estimate;
  estimate.mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
  estimate.low = estimate.high = estimate.mean;
  if (fraction >= 1) return estimate;
  estimate.band = std::sqrt((1 - (count - 1) / population) * std::log(2 / (1 - kConfidence)) / (2 * count));
  if (values.size() < kFewestForInterval || !std::isfinite(estimate.mean)) {
    estimate.low = estimate.high = std::numeric_limits<double>::quiet_NaN();
    return estimate;
  }
  double squares = 0;
  double cubes = 0;
  for (const double value : values) {
    const double above = value - estimate.mean;
    squares += above * above;
    cubes += above * above * above;
  }
  const double deviation = std::sqrt(squares / (count - 1));
  if (deviation == 0) return estimate;
  const double skewness = cubes / count / (deviation * deviation * deviation);
  const double quantile =
      boost::math::quantile(boost::math::students_t(count - 1), 0.5 + kConfidence / 2) / std::sqrt(count);
  const double unit = deviation * std::sqrt(1 - fraction);
  estimate.low -= unit * invert_hall(quantile, skewness, count);
  estimate.high -= unit * invert_hall(-quantile, skewness, count);
  return estimate;
}

}  // namespace indet
