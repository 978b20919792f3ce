#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace indet {

/// What became of one objective.
enum class Outcome : std::uint8_t {
  kOptimal,       ///< Certified: recomputed vertex, residuals within tolerance.
  kUnbounded,     ///< The value is ±inf; a ray of the recession cone proves it.
  kImprecise,     ///< A value is given, but its residuals or the rank decision leave it uncertain.
  kFailed,        ///< No value was found (NaN).
  kNotRequested,  ///< Left out by the user's choice of contacts (NaN), or there is no admissible state.
  kEnclosed,      ///< Certified: known to an interval that is no wider than asked for; no state attains it.
  kEstimate       ///< Not looked for (NaN): how far the force can vary is estimated (estimates.h).
};

/// The four objectives of a contact, in the order of the columns of every [M,4] table.
enum Column : std::uint8_t { kMinR = 0, kMaxR = 1, kMinT = 2, kMaxT = 3 };

/// Certain: optimal, unbounded or enclosed.
inline bool is_certified(Outcome outcome) {
  return outcome == Outcome::kOptimal || outcome == Outcome::kUnbounded || outcome == Outcome::kEnclosed;
}

/// Left out: by the user's choice, for an estimate, or because there is no admissible state.
inline bool is_left_out(Outcome outcome) {
  return outcome == Outcome::kNotRequested || outcome == Outcome::kEstimate;
}

const char* to_string(Outcome outcome);
const char* to_string(Column column);  ///< "R_min", "R_max", "T_min", "T_max".

/// One entry for each objective: row = contact, column = Column.
template <class T>
using Table4 = Eigen::Array<T, Eigen::Dynamic, 4, Eigen::RowMajor>;

/// Rows of numbers of one length, such as contact states.
template <class T>
using Rows = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

}  // namespace indet
