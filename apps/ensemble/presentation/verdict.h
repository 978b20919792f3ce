#pragma once

#include "libindet/statistics/bootstrap.h"

namespace indet {

/// What can be said of one row of the comparison with the paper.
constexpr const char* kAgrees = "agrees";
constexpr const char* kDiffers = "differs";
constexpr const char* kNotDecided = "not decided";

/// In the paper's column, where it has no number.
constexpr const char* kNotGiven = "not given";

constexpr const char* verdict_of(bool agrees) { return agrees ? kAgrees : kDiffers; }

/// Whether ours and the paper's number differ by at most two standard errors of their difference. Not decided
/// where these are more than a third of the paper's number, and so allow almost anything, nor without a value
/// or an error of ours.
const char* verdict(const Estimate& ours, double paper, double paper_error);

/// Whether `large` exceeds `small` by two standard errors of their difference; differs if it is so much
/// smaller, else not decided.
const char* verdict_of_order(const Estimate& large, const Estimate& small);

/// Whether we find what the paper gives without an error: within 10 %, or two standard errors of ours; not
/// decided where these are more than a third of it. Precondition: both are numbers.
const char* verdict_about(const Estimate& ours, double paper);

}  // namespace indet
