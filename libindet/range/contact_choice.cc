#include "indet/range/contact_choice.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <numeric>

#include "indet/base/random.h"

namespace indet {

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
  double squares = 0;
  for (const double value : values) squares += (value - estimate.mean) * (value - estimate.mean);
  double half = 0;
  if (fraction < 1) {
    half = std::numeric_limits<double>::quiet_NaN();
    if (values.size() > 1 && std::isfinite(estimate.mean)) {
      const boost::math::students_t student(count - 1);
      const double quantile = boost::math::quantile(student, 0.5 + kConfidence / 2);
      half = quantile * std::sqrt(squares / (count - 1) * (1 - fraction) / count);
    }
    estimate.band = std::sqrt((1 - (count - 1) / population) * std::log(2 / (1 - kConfidence)) / (2 * count));
  }
  estimate.low = estimate.mean - half;
  estimate.high = estimate.mean + half;
  return estimate;
}

}  // namespace indet
