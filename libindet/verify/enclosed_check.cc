#include "libindet/verify/enclosed_check.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "libindet/base/counted.h"
#include "libindet/range/analyze.h"

namespace indet {
namespace {

constexpr int kContactsAgain = 8;

void check_interval(const ForceRanges& ranges, double value, double lower, double upper, Outcome outcome,
                    const std::string& place, Comparisons& compare) {
  if (outcome != Outcome::kEnclosed) return;
  compare.require(std::isfinite(lower) && std::isfinite(upper), "{}: enclosed, but its bounds are {} and {}",
                  place, lower, upper);
  compare.equal(value / ranges.force_unit, (lower / 2 + upper / 2) / ranges.force_unit,
                place + ": middle of its bounds");
  const double allowed = ranges.gap * std::max(1.0, std::abs(value) / ranges.force_unit);
  compare.require((upper - lower) / ranges.force_unit <= allowed * (1 + tolerance::kAgreement),
                  "{}: enclosed, but its bounds are {} mg apart instead of {}", place,
                  (upper - lower) / ranges.force_unit, allowed);
}

/// Contacts that have an enclosed value, a few of them.
std::vector<int> some_enclosed(const ForceRanges& ranges) {
  std::vector<int> enclosed;
  for (Eigen::Index i = 0; i < ranges.outcome.rows(); ++i) {
    if ((ranges.outcome.row(i) == Outcome::kEnclosed).any()) enclosed.push_back(static_cast<int>(i));
  }
  const std::size_t count = std::min<std::size_t>(kContactsAgain, enclosed.size());
  std::vector<int> some;
  for (std::size_t k = 0; k < count; ++k) some.push_back(enclosed[k * enclosed.size() / count]);
  return some;
}

void check_by_programs(const Packing& packing, const ForceRanges& ranges, const ProgressCallback& progress,
                       Comparisons& compare) {
  AnalyzeOptions options;
  options.method = Method::kLp;
  options.states.kind = StateChoice::Kind::kNone;
  options.contacts.kind = ContactChoice::Kind::kList;
  options.contacts.list = some_enclosed(ranges);
  options.progress = progress;
  const ForceRanges again = analyze(packing, options);
  for (const int i : options.contacts.list) {
    for (int column = 0; column < 4; ++column) {
      if (ranges.outcome(i, column) != Outcome::kEnclosed) continue;
      compare.require(again.upper(i, column) >= ranges.lower(i, column) &&
                          again.lower(i, column) <= ranges.upper(i, column),
                      "contact {} {}: between {} and {} is stored, but a linear program gives {}", i,
                      to_string(static_cast<Column>(column)), ranges.lower(i, column),
                      ranges.upper(i, column), again.value(i, column));
    }
  }
}

}  // namespace

void check_enclosed(const Packing& packing, const ForceRanges& ranges, const ProgressCallback& progress,
                    Comparisons& compare) {
  if (ranges.method != Method::kBarrier) return;
  compare.require(ranges.gap > 0, "gap: {} is stored", ranges.gap);
  for (Eigen::Index i = 0; i < ranges.outcome.rows(); ++i) {
    for (int column = 0; column < 4; ++column) {
      check_interval(ranges, ranges.value(i, column), ranges.lower(i, column), ranges.upper(i, column),
                     ranges.outcome(i, column),
                     fmt::format("contact {} {}", i, to_string(static_cast<Column>(column))), compare);
    }
  }
  const Reactions& r = ranges.reactions;
  for (Eigen::Index k = 0; k < r.count(); ++k) {
    for (const int end : {0, 1}) {
      check_interval(ranges, r.value(k, end), r.lower(k, end), r.upper(k, end), r.outcome(k, end),
                     fmt::format("reactions: {} of row {}", end == 0 ? "minimum" : "maximum", k), compare);
    }
  }
  if (ranges.enclosed == 0) return;
  const bool is_small = ranges.unknowns <= tolerance::kMostForPrograms;
  if (is_small) check_by_programs(packing, ranges, progress, compare);
  const Eigen::Index with_duals = ranges.duals.contacts.size();
  const std::string duals =
      with_duals > 0 ? fmt::format(", but for those of {} with multipliers", counted(with_duals, "contact"))
                     : "";
  compare.leave_unchecked(
      is_small ? fmt::format(
                     "that intervals hold their values{}{} those of {} contacts, which linear programs found "
                     "again (--exact checks all)",
                     duals, with_duals > 0 ? " and" : ", but for", some_enclosed(ranges).size())
               : fmt::format("that intervals hold their values{} (the packing is too large for linear "
                             "programs; indet analyze … --duals stores multipliers)",
                             duals));
}

}  // namespace indet
