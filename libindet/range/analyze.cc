#include "libindet/range/analyze.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "libindet/base/error.h"
#include "libindet/base/stopwatch.h"
#include "libindet/polytope/central_polytope.h"
#include "libindet/polytope/force_polytope.h"
#include "libindet/range/analysis_start.h"
#include "libindet/range/barrier_analysis.h"
#include "libindet/range/distance_search.h"
#include "libindet/range/drop_states.h"
#include "libindet/range/enclosure.h"
#include "libindet/range/estimated_ranges.h"
#include "libindet/range/exact_ends.h"
#include "libindet/range/exact_ranges.h"
#include "libindet/range/extrema.h"
#include "libindet/range/extremal_search.h"
#include "libindet/range/open_ends.h"
#include "libindet/range/proven_rays.h"
#include "libindet/range/reactions.h"

namespace indet {
namespace {

/// How the search of a polytope is to be done.
SearchOptions search_options(const ForcePolytope& polytope, const AnalyzeOptions& options, Method method) {
  int largest = 0;
  for (const PolytopeBlock& block : polytope.blocks) largest = std::max(largest, block.view.dim());
  SearchOptions search;
  // Each bound of a force is a row more of the edges' formulation, but not of the dual one.
  const bool has_bounds = !polytope.problem.bounds.empty();
  search.formulation =
      options.formulation.value_or(has_bounds ? Formulation::kDual : choose_formulation(largest));
  search.method = method;
  search.paper = options.paper;
  search.lp = options.lp;
  search.threads = options.threads;
  search.solver_states = options.solver_states;
  if (options.progress) {
    search.progress = [&options](std::int64_t settled, std::int64_t total) {
      return options.progress({"force ranges", settled, total, {}});
    };
  }
  return search;
}

/// The contacts whose ranges are to be found, ascending.
struct Wanted {
  std::vector<int> contacts;
  ContactRequest request;
};

Wanted choose_contacts(const ContactChoice& choice, const ForcePolytope& polytope, int contacts) {
  Wanted wanted;
  wanted.request.choice = choice.kind;
  const bool is_sample = choice.kind == ContactChoice::Kind::kSample;
  if (is_sample) wanted.request.sample_seed = static_cast<std::int64_t>(choice.seed);
  if (is_sample && polytope.central && choice.sample_size < contacts) {
    static_cast<ContactDraw&>(wanted.request) = draw_contacts(polytope, choice.sample_size, choice.seed);
    for (int i = 0; i < contacts; ++i) {
      if (wanted.request.drawn[i] > 0) wanted.contacts.push_back(i);
    }
  } else {
    wanted.contacts = chosen_contacts(choice, contacts);
  }
  wanted.request.requested = static_cast<int>(wanted.contacts.size());
  return wanted;
}

/// Says why there are no estimates of a polytope that is not empty.
void require_centre(const ForcePolytope& polytope) {
  if (polytope.doubtful)
    throw InputError(
        "rounding decides whether contact forces balance here, or stay bounded, and no range can be "
        "estimated; --accuracy standard finds what there is");
  if (polytope.central) return;
  const bool is_unbounded = polytope.status == PolytopeStatus::kUnbounded;
  throw InputError(std::string(is_unbounded ? "some contact forces can grow without limit here"
                                            : "the polytope of contact forces is too thin here") +
                   ", and ranges are estimated from its analytic centre, which there is none of; --accuracy "
                   "standard finds them");
}

ForceRanges analyze_in_doubles(const Packing& packing, const AnalyzeOptions& options) {
  std::map<std::string, double> seconds;
  StageTimes times(seconds);
  const auto stage = [&](const char* name) {
    return interval_options(options.gap, options.threads, options.progress, name);
  };
  AnalysisStart start = begin_analysis(packing, options);
  auto& [kept, choice, polytope] = start;
  if (options.estimate && polytope.status != PolytopeStatus::kEmpty) {
    require_centre(polytope);
    times.mark("polytope");
    ForceRanges ranges = estimate_ranges(packing, polytope, *options.estimate, stage("force ranges"));
    times.mark("estimates");
    ranges.seconds = std::move(seconds);
    return ranges;
  }
  const auto [contacts, request] = choose_contacts(options.contacts, polytope, packing.contact_count());
  if (const auto reason = options.states.defect(contacts)) throw InputError(*reason);
  times.mark("polytope");
  if (choice.method == Method::kBarrier) {
    const BarrierAnalysis analysis(packing, start, contacts, request, options);
    times.mark("ranges");
    std::optional<ForceRanges> ranges = analysis.find(contacts, request, options.threads, options.progress);
    if (ranges) {
      for (const auto& [name, time] : seconds) ranges->seconds[name] += time;
      return std::move(*ranges);
    }
    times.mark("ranges");
    polytope = find_force_polytope(packing, options.lp);
    choice = {Method::kLp,
              "forces are unbounded, and the barrier method bounds some of the limited ones too widely"};
    times.mark("polytope");
  }
  const SearchOptions search = search_options(polytope, options, choice.method);
  Extrema extrema = find_extrema(packing, polytope, contacts, kept, search);
  extrema.reason = std::move(choice.reason);
  times.mark("ranges");
  seconds["states"] = extrema.state_seconds;
  seconds["ranges"] -= extrema.state_seconds;
  FoundReactions reactions;
  if (options.reactions)
    reactions = find_reactions(packing, polytope, extrema, search.formulation, options.lp);
  times.mark("reactions");
  if (!polytope.central) add_centre(polytope);
  Enclosures enclosures = enclose_values(polytope, extrema, reactions.optima, stage("enclosures").progress);
  enclosures.proven = enclosures.proven && prove_rays(packing, *polytope.exact, extrema.rays);
  const bool reactions_proven =
      enclosures.proven && prove_rays(packing, *polytope.exact, reactions.reactions.rays);
  if (enclosures.proven && polytope.status == PolytopeStatus::kUnbounded) {
    // What is promised is relative to loads, which may be far below 1 mg.
    const double gap = 0.01 * tolerance::kCertifiedWidth;
    close_open_ends(packing, contacts, extrema, reactions, {gap, options.threads, {}}, enclosures);
  }
  if (enclosures.proven && polytope.exact && options.exactness != AnalyzeOptions::Exactness::kNowhere)
    settle_exactly(packing, polytope, extrema, reactions.optima, enclosures);
  times.mark("enclosures");
  ForceRanges ranges = assemble(packing, summarise(packing, polytope), request, extrema, enclosures);
  ranges.reactions = certify_reactions(reactions, enclosures.sums, reactions_proven);
  times.mark("measures");
  if (options.smallest_distances) {
    ranges.smallest = find_smallest_distances(polytope, ranges, contacts, stage("smallest distances"));
    times.mark("smallest distances");
  }
  ranges.seconds = std::move(seconds);
  return ranges;
}

/// The request, and the equations as double precision sees them: what results say where no more is known.
ForceRanges equations_alone(const Packing& packing, const ContactRequest& request) {
  ForcePolytope polytope;
  polytope.natural = pose_equilibrium(packing);
  polytope.natural_null_space =
      std::make_shared<NullSpace>(compute_null_space(polytope.natural.matrix, polytope.natural.load()));
  polytope.rank_ambiguous = polytope.natural_null_space->ambiguous;
  ForceRanges ranges;
  static_cast<ProblemSummary&>(ranges) = summarise(packing, polytope);
  static_cast<ContactRequest&>(ranges) = request;
  ranges.vertex.resize(0, 4);
  return ranges;
}

/// The smallest distances beside exact results: those that double precision found of the same polytope, else
/// none.
SmallestDistances distances_beside(const ForceRanges& exact, const ForceRanges& found,
                                   const std::vector<int>& contacts) {
  const bool is_same = !found.doubtful && found.status == exact.status &&
                       found.smallest.outcome.rows() == exact.outcome.rows();
  if (is_same) return found.smallest;
  SmallestDistances none;
  const Eigen::Index count = exact.outcome.rows();
  for (Eigen::VectorXd* values : {&none.d_R, &none.d_T}) values->setConstant(count, ForceRanges::kNaN);
  for (auto* table : {&none.lower, &none.shortage}) table->setConstant(count, 2, ForceRanges::kNaN);
  none.outcome.setConstant(count, 2, Outcome::kNotRequested);
  for (const int i : contacts) {
    if (exact.status != PolytopeStatus::kEmpty) none.outcome.row(i) = Outcome::kFailed;
  }
  return none;
}

bool is_marked(const ForceRanges& ranges) {
  return ranges.doubtful || ranges.imprecise + ranges.failed + ranges.reactions.uncertain() > 0;
}

/// The contacts that were asked for, ascending.
std::vector<int> requested_contacts(const ForceRanges& ranges, const ContactChoice& choice, int contacts) {
  if (ranges.draws == 0) return chosen_contacts(choice, contacts);
  std::vector<int> drawn;
  for (int i = 0; i < contacts; ++i) {
    if (ranges.drawn[i] > 0) drawn.push_back(i);
  }
  return drawn;
}

}  // namespace

ForceRanges analyze(const Packing& packing, const AnalyzeOptions& options) {
  using Exactness = AnalyzeOptions::Exactness;
  const bool may_be_exact = options.exactness != Exactness::kNowhere && !options.estimate &&
                            options.duals.kind == DualChoice::Kind::kNone;
  const bool is_asked_for = may_be_exact && options.exactness == Exactness::kEverywhere;
  const StateChoice kept = limited(options.states, packing.contact_count());
  AnalyzeOptions in_doubles = options;
  if (is_asked_for) {
    // Exact searches start from states, so that all of them are kept on the way, and linear programs have
    // them.
    in_doubles.states = {
        .kind = kept.kind == StateChoice::Kind::kNone ? StateChoice::Kind::kSolver : kept.kind,
        .within_limit = false};
    if (!in_doubles.method) in_doubles.method = Method::kLp;
  }
  const auto settle = [&](const ForceRanges& found, const std::vector<int>& contacts) {
    ExactOptions exactly{options.exact_work, options.reactions, options.threads, {}};
    if (options.progress) {
      exactly.progress = [&](std::int64_t settled, std::int64_t total) {
        return options.progress({"exact arithmetic", settled, total, {}});
      };
    }
    const auto begin = std::chrono::steady_clock::now();
    std::optional<ForceRanges> exact = find_exact_ranges(packing, contacts, kept, found, exactly);
    if (!exact) return exact;
    exact->seconds = found.seconds;
    if (options.smallest_distances) exact->smallest = distances_beside(*exact, found, contacts);
    exact->solver_states = found.solver_states;
    exact->seconds["exact arithmetic"] =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return exact;
  };
  ForceRanges ranges;
  try {
    ranges = analyze_in_doubles(packing, in_doubles);
  } catch (const LibraryError&) {
    // A linear program could not be solved, or rounding decides whether forces balance.
    const bool is_walk =
        options.method && *options.method != Method::kLp && *options.method != Method::kBarrier;
    if (!may_be_exact || is_walk) throw;  // what a walk does not find is a result about it
    const std::vector<int> contacts = chosen_contacts(options.contacts, packing.contact_count());
    if (const auto reason = options.states.defect(contacts)) throw InputError(*reason);
    ContactRequest request;
    request.choice = options.contacts.kind;
    if (request.choice == ContactChoice::Kind::kSample)
      request.sample_seed = static_cast<std::int64_t>(options.contacts.seed);
    request.requested = static_cast<int>(contacts.size());
    std::optional<ForceRanges> exact = settle(equations_alone(packing, request), contacts);
    if (!exact) throw;
    return std::move(*exact);
  }
  // What the paper's walk does not find is a result about it.
  const bool is_unsettled = ranges.doubtful || (ranges.method != Method::kPivotingPaper && is_marked(ranges));
  const bool wants_exact =
      is_asked_for || (may_be_exact && ranges.method != Method::kBarrier && is_unsettled);
  if (!wants_exact) return ranges;
  std::optional<ForceRanges> exact =
      settle(ranges, requested_contacts(ranges, options.contacts, packing.contact_count()));
  if (exact) return std::move(*exact);
  return is_asked_for ? drop_states(std::move(ranges), kept) : ranges;
}

Formulation choose_formulation(int dim) {
  constexpr int kCrossOver = 30;
  return dim <= kCrossOver ? Formulation::kDual : Formulation::kEdge;
}

AnalyzeOptions options_for(Accuracy accuracy) {
  AnalyzeOptions options;
  if (accuracy == Accuracy::kFast) options.states.kind = StateChoice::Kind::kSolver;
  return options;
}

}  // namespace indet
