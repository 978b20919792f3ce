#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "libindet/base/constants.h"
#include "libindet/range/force_ranges.h"
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
  void write(ExtremalStates& extremal) const {
    const Eigen::Index width = ranges_.active.cols();
    const auto count = static_cast<Eigen::Index>(rows_.size());
    extremal.states.resize(count, 2 * ranges_.value.rows());
    extremal.active.setConstant(count, width, -1);
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      const auto row = static_cast<Eigen::Index>(k);
      extremal.states.row(row) = rows_[k].transpose();
      for (Eigen::Index a = 0; a < std::min(width, static_cast<Eigen::Index>(active_[k].size())); ++a)
        extremal.active(row, a) = active_[k][static_cast<std::size_t>(a)];
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

/// The extrema as a search would have found them that returned what is stored.
Extrema stored_extrema(const ForceRanges& ranges) {
  Extrema extrema;
  static_cast<ExtremalStates&>(extrema) = ranges;
  static_cast<SearchWork&>(extrema) = ranges;
  extrema.claim = ranges.outcome;
  extrema.dual_residual = ranges.dual_residual;
  extrema.ray_residual = ranges.primal_residual;
  extrema.value = ranges.value;
  extrema.primal_residual = ranges.primal_residual;
  return extrema;
}

/// Where not `proven`, nothing is certified.
Reactions adopt_reactions(const ExactReactions& check, const Reactions& stored, bool proven) {
  Reactions r = stored;
  Rows<double> states(0, stored.states.cols());
  const auto add = [&](const auto& row) {
    states.conservativeResize(states.rows() + 1, Eigen::NoChange);
    states.bottomRows(1) = row;
    return static_cast<std::int32_t>(states.rows() - 1);
  };
  for (Eigen::Index k = 0; k < r.count(); ++k) {
    for (const int end : {0, 1}) {
      Outcome& outcome = r.outcome(k, end);
      if (check.proof(k, end) == Proof::kProven || check.proof(k, end) == Proof::kRepaired) {
        r.value(k, end) = check.value(k, end);
        r.lower(k, end) = check.lower(k, end);
        r.upper(k, end) = check.upper(k, end);
        const bool infinite = std::isinf(check.value(k, end));
        outcome = infinite ? Outcome::kUnbounded : Outcome::kOptimal;
        r.vertex(k, end) = infinite ? -1 : add(check.states.row(check.vertex(k, end)));
        if (!infinite) r.ray(k, end) = -1;
      } else if (r.vertex(k, end) >= 0) {
        r.vertex(k, end) = add(stored.states.row(r.vertex(k, end)));
      }
      const bool has_proof = outcome != Outcome::kUnbounded || r.ray(k, end) >= 0;
      if (std::isnan(r.value(k, end)) || (proven && has_proof)) continue;
      outcome = Outcome::kImprecise;
      r.lower(k, end) = -kInfinity;
      r.upper(k, end) = kInfinity;
    }
  }
  r.states = std::move(states);
  return r;
}

}  // namespace

ForceRanges adopt_exact(const Packing& packing, const ExactCheck& check, const ForceRanges& ranges) {
  if (ranges.status == PolytopeStatus::kEmpty) {
    ForceRanges result = ranges;
    result.doubtful = !check.proves_emptiness;
    return result;
  }
  Extrema extrema = stored_extrema(ranges);
  Enclosures enclosures{
      ranges.lower, ranges.upper, ranges.sensitivity, check.passed() && check.rank == ranges.rank, {}};
  States states(check, ranges);
  for (Eigen::Index i = 0; i < ranges.outcome.rows(); ++i) {
    for (int column = 0; column < 4; ++column) {
      const Proof proof = check.proof(i, column);
      std::int32_t& vertex = extrema.vertex(i, column);
      Outcome& claim = extrema.claim(i, column);
      if (proof == Proof::kProven || proof == Proof::kRepaired) {
        const double lower = check.lower(i, column);
        const double upper = check.upper(i, column);
        const bool infinite = std::isinf(lower) && lower == upper;
        claim = infinite ? Outcome::kUnbounded : Outcome::kOptimal;
        vertex = infinite ? -1 : states.exact(check.vertex(i, column));
        if (infinite) extrema.value(i, column) = lower;
        enclosures.lower(i, column) = lower;
        enclosures.upper(i, column) = upper;
        extrema.dual_residual(i, column) = 0;
        // The state is another one; that no bound is known still holds.
        if (proof == Proof::kRepaired && std::isfinite(enclosures.sensitivity.value(i, column)))
          enclosures.sensitivity.claim(i, column) = static_cast<std::uint8_t>(SensitivityClaim::kNone);
      } else {
        if (claim == Outcome::kOptimal || claim == Outcome::kUnbounded) claim = Outcome::kImprecise;
        if (vertex >= 0) vertex = states.stored(vertex);
      }
    }
  }
  states.write(extrema);
  extrema.value = extrema.value.isFinite().select(extrema.value, kNaN);
  note_states(extrema.states, extrema.vertex, StateChecker(packing), extrema);
  ForceRanges result = assemble(packing, ranges, ranges, extrema, enclosures);
  result.seconds = ranges.seconds;
  result.smallest = ranges.smallest;
  result.reactions = adopt_reactions(check.reactions, ranges.reactions, enclosures.proven);
  return result;
}

}  // namespace indet
