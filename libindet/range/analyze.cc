#include "libindet/range/analyze.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "libindet/base/tolerances.h"
#include "libindet/exact/certificate.h"
#include "libindet/polytope/force_polytope.h"
#include "libindet/range/enclosure.h"
#include "libindet/range/extrema.h"
#include "libindet/range/extremal_search.h"
#include "libindet/range/reactions.h"

namespace indet {
namespace {

/// Adds the time since the last mark to a stage.
class Stopwatch {
 public:
  explicit Stopwatch(std::map<std::string, double>& seconds) : seconds_(seconds) {}
  void mark(const std::string& stage) {
    const auto now = std::chrono::steady_clock::now();
    seconds_[stage] += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }

 private:
  std::map<std::string, double>& seconds_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Repeats each ray in rational numbers. Where one is not a ray exactly, forces that grow along it are
/// limited after all, and other values may belong to vertices that are far away.
bool proves_rays(const Packing& packing, const exact::ContactProblem& exact, const Rows<double>& rays) {
  if (rays.rows() == 0) return true;
  for (Eigen::Index q = 0; q < rays.rows(); ++q) {
    const std::span<const double> ray(&rays(q, 0), static_cast<std::size_t>(rays.cols()));
    if (!exact::proves_ray(exact, exact::edge_strengths(packing, ray), tolerance::kExactZero)) return false;
  }
  return true;
}

/// How the search of a polytope is to be done.
SearchOptions search_options(const ForcePolytope& polytope, const AnalyzeOptions& options) {
  int largest = 0;
  for (const PolytopeBlock& block : polytope.blocks) largest = std::max(largest, block.view.dim());
  SearchOptions search;
  search.formulation = options.formulation.value_or(choose_formulation(largest));
  search.method = options.method;
  search.paper = options.paper;
  search.lp = options.lp;
  search.threads = options.threads;
  search.canonical_states = options.canonical_states;
  search.solver_states = options.solver_states;
  if (options.progress) {
    search.progress = [&options](std::int64_t settled, std::int64_t total) {
      return options.progress({"force ranges", settled, total, {}});
    };
  }
  return search;
}

ContactRequest describe_request(const ContactChoice& choice, std::size_t requested) {
  const bool is_sample = choice.kind == ContactChoice::Kind::kSample;
  return {choice.kind, static_cast<int>(requested), is_sample ? static_cast<std::int64_t>(choice.seed) : -1};
}

}  // namespace

Formulation choose_formulation(int dim) {
  constexpr int kCrossOver = 30;
  return dim <= kCrossOver ? Formulation::kDual : Formulation::kEdge;
}

AnalyzeOptions options_for(Accuracy accuracy) {
  AnalyzeOptions options;
  options.canonical_states = accuracy != Accuracy::kFast;
  return options;
}

ForceRanges analyze(const Packing& packing, const AnalyzeOptions& options) {
  std::map<std::string, double> seconds;
  Stopwatch stopwatch(seconds);
  const ForcePolytope polytope = find_force_polytope(packing, options.lp);
  stopwatch.mark("polytope");
  const std::vector<int> contacts = chosen_contacts(options.contacts, packing.contact_count());
  const SearchOptions search = search_options(polytope, options);
  const Extrema extrema = find_extrema(polytope, contacts, packing.simulated_forces(), search);
  stopwatch.mark("ranges");
  seconds["states"] = extrema.state_seconds;
  seconds["ranges"] -= extrema.state_seconds;
  const FoundReactions reactions = find_reactions(packing, polytope, extrema, search.formulation, options.lp);
  stopwatch.mark("reactions");
  Enclosures enclosures = enclose_values(polytope, extrema, reactions.optima);
  enclosures.proven = enclosures.proven && proves_rays(packing, *polytope.exact, extrema.rays);
  const bool reactions_proven =
      enclosures.proven && proves_rays(packing, *polytope.exact, reactions.reactions.rays);
  stopwatch.mark("enclosures");
  ForceRanges ranges = assemble(packing, summarise(packing, polytope),
                                describe_request(options.contacts, contacts.size()), extrema, enclosures);
  ranges.reactions = certify_reactions(reactions, enclosures.sums, reactions_proven);
  stopwatch.mark("measures");
  ranges.seconds = std::move(seconds);
  return ranges;
}

}  // namespace indet
