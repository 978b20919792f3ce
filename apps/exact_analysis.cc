#include "apps/exact_analysis.h"

#include <chrono>
#include <utility>

#include "libindet/range/drop_states.h"
#include "libindet/verify/exact_check.h"

namespace indet::app {
namespace {

/// Where double precision leaves something in doubt, some minutes of exact arithmetic are welcome.
constexpr double kMostExactWork = 2e8;

}  // namespace

ForceRanges analyze_exactly(const Packing& packing, AnalyzeOptions analysis, const Context& context) {
  const StateChoice kept = limited(analysis.states, packing.contact_count());
  analysis.states = {.kind = kept.kind == StateChoice::Kind::kNone ? StateChoice::Kind::kSolver : kept.kind,
                     .within_limit = false};
  if (!analysis.method) analysis.method = Method::kLp;  // exact proofs start from its vertices
  analysis.exact_work = kMostExactWork;
  const ForceRanges ranges = analyze(packing, analysis);
  if (ranges.exact) return drop_states(ranges, kept);
  const auto start = std::chrono::steady_clock::now();
  ExactCheckOptions options;
  options.threads = context.thread_count();
  options.progress = context.progress();
  ForceRanges proven = adopt_exact(packing, check_exactly(packing, ranges, options), ranges);
  proven.seconds["exact arithmetic"] =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return drop_states(std::move(proven), kept);
}

ForceRanges with_states(const Packing& packing, ForceRanges ranges, const Context& context) {
  const auto stateless = (ranges.vertex < 0) && ranges.value.isFinite();
  if (!stateless.any()) return ranges;
  AnalyzeOptions analysis;
  analysis.threads = context.thread_count();
  analysis.progress = context.progress();
  analysis.states = {.kind = StateChoice::Kind::kSolver, .within_limit = false};
  analysis.contacts.kind = ContactChoice::Kind::kList;
  for (Eigen::Index i = 0; i < ranges.outcome.rows(); ++i) {
    if ((ranges.outcome.row(i) != Outcome::kNotRequested).any())
      analysis.contacts.list.push_back(static_cast<int>(i));
  }
  const ForceRanges found = analyze(packing, analysis);
  ranges.states = found.states;
  ranges.active = found.active;
  ranges.vertex = found.vertex;
  return ranges;
}

}  // namespace indet::app
