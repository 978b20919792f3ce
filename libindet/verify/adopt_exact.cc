#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "libindet/range/certify.h"
#include "libindet/range/measures.h"
#include "libindet/verify/exact_check.h"

namespace indet {
namespace {

/// Collects the rows of the new table of states: exact ones, and stored ones of objectives that stay as they
/// are.
class States {
 public:
  States(const ExactCheck& check, const ForceRanges& ranges) : check_(check), ranges_(ranges) {}

  int exact(int row) {
    return add({1, row}, check_.states.row(row).transpose(),
               check_.zero_edges[static_cast<std::size_t>(row)]);
  }
  int stored(int row) {
    return add({0, row}, ranges_.states.row(row).transpose(),
               std::vector<std::int32_t>(ranges_.active.row(row).begin(), ranges_.active.row(row).end()));
  }
  void write(ForceRanges& ranges) const {
    const Eigen::Index width = ranges.active.cols();
    const auto count = static_cast<Eigen::Index>(rows_.size());
    ranges.states.resize(count, 2 * ranges.value.rows());
    ranges.active.setConstant(count, width, -1);
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      const auto row = static_cast<Eigen::Index>(k);
      ranges.states.row(row) = rows_[k].transpose();
      for (Eigen::Index a = 0; a < std::min(width, static_cast<Eigen::Index>(active_[k].size())); ++a)
        ranges.active(row, a) = active_[k][static_cast<std::size_t>(a)];
    }
  }

 private:
  int add(std::pair<int, int> key, Eigen::VectorXd state, std::vector<std::int32_t> active) {
    const auto [entry, is_new] = numbers_.emplace(key, static_cast<int>(rows_.size()));
    if (is_new) {
      rows_.push_back(std::move(state));
      active_.push_back(std::move(active));
    }
    return entry->second;
  }
  const ExactCheck& check_;
  const ForceRanges& ranges_;
  std::map<std::pair<int, int>, int> numbers_;
  std::vector<Eigen::VectorXd> rows_;
  std::vector<std::vector<std::int32_t>> active_;
};

}  // namespace

void adopt_exact(const Packing& packing, const ExactCheck& check, ForceRanges& ranges) {
  if (ranges.status == PolytopeStatus::kEmpty) {
    ranges.doubtful = !check.proves_emptiness;
    return;
  }
  ranges.doubtful = !check.passed() || check.rank != ranges.rank;
  States states(check, ranges);
  for (Eigen::Index i = 0; i < ranges.outcome.rows(); ++i) {
    for (int column = 0; column < 4; ++column) {
      const Proof proof = check.proof(i, column);
      int& vertex = ranges.vertex(i, column);
      Outcome& outcome = ranges.outcome(i, column);
      if (proof == Proof::kProven || proof == Proof::kRepaired) {
        const double lower = check.lower(i, column);
        const double upper = check.upper(i, column);
        const bool infinite = std::isinf(lower) && lower == upper;
        outcome = infinite ? Outcome::kUnbounded : Outcome::kOptimal;
        vertex = infinite ? -1 : states.exact(check.vertex(i, column));
        if (infinite) ranges.value(i, column) = lower;
        ranges.lower(i, column) = lower;
        ranges.upper(i, column) = upper;
        ranges.dual_residual(i, column) = 0;
      } else {
        if (outcome == Outcome::kOptimal || outcome == Outcome::kUnbounded) outcome = Outcome::kImprecise;
        if (vertex >= 0) vertex = states.stored(vertex);
      }
    }
  }
  states.write(ranges);
  ranges.objectives = ranges.certified = ranges.imprecise = ranges.failed = ranges.unbounded = 0;
  certify(packing, ranges);
  compute_measures(packing, ranges);
}

}  // namespace indet
