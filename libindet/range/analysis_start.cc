#include "libindet/range/analysis_start.h"

#include <optional>
#include <utility>

#include "libindet/base/error.h"
#include "libindet/base/tolerances.h"
#include "libindet/polytope/central_polytope.h"

namespace indet {
namespace {

/// Contacts from which the barrier method is the faster one for values, and for canonical states too
/// (docs/decisions/barrier-method.md).
constexpr int kFewestForBarrier = 200;
constexpr int kFewestForCentralStates = 500;

/// The polytope in the form that the method works on. Where the barrier method cannot decide, linear programs
/// do, and they find the values, too, unless F is bounded after all. So they do where it cannot prove enough
/// of an unbounded F, or has no states of it, in a packing that is small enough for their dense matrices.
ForcePolytope find_polytope(const Packing& packing, const AnalyzeOptions& options, bool wants_states,
                            MethodChoice& choice) {
  if (choice.method != Method::kBarrier) return find_force_polytope(packing, options.lp);
  std::optional<ForcePolytope> sparse = find_sparse_polytope(packing);
  const bool is_large = 2 * packing.contact_count() > tolerance::kMostForDense;
  const bool has_centre = sparse && (sparse->central || (sparse->unbounded && (is_large || !wants_states)));
  if (sparse && is_large && sparse->status == PolytopeStatus::kUnbounded && !has_centre)
    choice.reason =
        "forces are unbounded, the bodies that they press together can still move, for which this method has "
        "no values, and the packing is too large for lp";
  if (sparse && (is_large || has_centre || sparse->status == PolytopeStatus::kEmpty))
    return std::move(*sparse);
  if (!sparse && is_large)
    throw LibraryError(
        "double precision does not tell whether contact forces balance here, or whether they stay "
        "bounded, and exact arithmetic is too slow for " +
        std::to_string(packing.contact_count()) + " contacts");
  ForcePolytope polytope = find_force_polytope(packing, options.lp);
  if (!add_centre(polytope)) {
    choice.method = Method::kLp;
    choice.reason = std::string("the barrier method is for polytopes with a centre, and this one is ") +
                    (polytope.status == PolytopeStatus::kBounded ? "too thin" : to_string(polytope.status));
  }
  return polytope;
}

/// What the barrier method keeps. Who asks for it by name asks for intervals, unless states are asked for,
/// too; where the level of accuracy would do with those of a solver, canonical ones take their place.
StateChoice states_by_barrier(StateChoice kept, bool is_asked_for) {
  if (!kept.within_limit && kept.kind == StateChoice::Kind::kSolver)
    throw InputError(
        "the barrier method lands inside of optimal faces and not on extremal states; canonical ones are "
        "found, or --method lp finds those of a solver");
  if (kept.kind == StateChoice::Kind::kSolver) kept.kind = StateChoice::Kind::kCanonical;
  if (is_asked_for && kept.within_limit && kept.keeps_all()) kept.kind = StateChoice::Kind::kNone;
  return kept;
}

}  // namespace

StateChoice kept_states(const AnalyzeOptions& options, int contacts) {
  const StateChoice kept = limited(options.states, contacts);
  const Method method = options.method ? *options.method : choose_method(contacts, kept).method;
  return method == Method::kBarrier ? states_by_barrier(kept, options.method.has_value()) : kept;
}

AnalysisStart begin_analysis(const Packing& packing, const AnalyzeOptions& options) {
  const int contacts = packing.contact_count();
  AnalysisStart start;
  start.kept = kept_states(options, contacts);
  start.choice = options.method ? MethodChoice{*options.method, ""}
                                : choose_method(contacts, limited(options.states, contacts));
  if (options.estimate) start.choice.method = Method::kBarrier;
  const bool wants_states = start.kept.kind != StateChoice::Kind::kNone;
  start.polytope = find_polytope(packing, options, wants_states, start.choice);
  return start;
}

MethodChoice choose_method(int contacts, const StateChoice& states) {
  using Kind = StateChoice::Kind;
  if (states.kind == Kind::kNone) {
    if (contacts < kFewestForBarrier) return {Method::kLp, "a small packing"};
    return {Method::kBarrier, "a large packing, and no extremal states are wanted"};
  }
  if (states.kind == Kind::kSolver && !states.within_limit)
    return {Method::kLp, "the extremal states on which a solver lands are wanted"};
  if (contacts < kFewestForCentralStates) return {Method::kLp, "extremal states are wanted"};
  return {Method::kBarrier, "a large packing"};
}

}  // namespace indet
