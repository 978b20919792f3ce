#include "apps/exact_analysis.h"

namespace indet::app {

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
