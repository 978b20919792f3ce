#pragma once

#include <cstdint>
#include <vector>

namespace indet {

/// The contacts whose ranges are wanted.
struct ContactChoice {
  enum class Kind : std::uint8_t { kAll, kSample, kList };
  Kind kind = Kind::kAll;
  int sample_size = 0;      ///< kSample: how many contacts, drawn without replacement
  std::uint64_t seed = 1;   ///< kSample
  std::vector<int> list{};  ///< kList: indices of contacts, in any order
};

/// "all", "sample", "list".
const char* to_string(ContactChoice::Kind kind);

/// The chosen among `contacts` contacts, ascending, each once. A sample larger than that is all of them. The
/// same seed gives the same sample on any machine. Precondition: 0 ≤ list entries < contacts.
std::vector<int> chosen_contacts(const ContactChoice& choice, int contacts);

/// What a sample of contacts tells about all contacts.
struct SampleEstimate {
  double mean = 0;
  double low = 0, high = 0;  ///< confidence interval of the mean over all contacts
  double band = 0;  ///< the fraction of all contacts with a value ≤ v lies within ± band of the sample's, for
                    ///< all v at once
};
/// The level of confidence of intervals and bands.
inline constexpr double kConfidence = 0.95;

/// K values, drawn without replacement from `population` (M) ones, f = K/M.
///
///   mean ± t_{K−1} s √((1 − f)/K)
///   band = √((1 − (K − 1)/M) ln(2/α) / 2K),   α = 1 − 0.95
///
/// The interval is Student's with the finite population correction, exact for normally distributed values;
/// the band is that of Dvoretzky, Kiefer and Wolfowitz with Serfling's correction.
///
/// docs/accuracy.md has the measured coverage for force ranges, whose distribution is skewed. An infinite
/// value makes the mean infinite and its interval NaN, as a single value does. Precondition: K ≥ 1; no NaN.
SampleEstimate estimate_from_sample(const std::vector<double>& values, int population);

}  // namespace indet
