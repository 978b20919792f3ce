#include "libindet/range/dealt_analysis.h"

#include <fmt/format.h>

#include "libindet/base/counted.h"
#include "libindet/base/error.h"

namespace indet {
namespace {

constexpr const char* kNeedsBarrier =
    "linear programs build on what others have found, so that a part would depend on what else is in it; "
    "with "
    "--method barrier it does not";

AnalysisStart begin(const Packing& packing, const AnalyzeOptions& options) {
  if (const auto obstacle = obstacle_to_dealing(options, packing.contact_count()))
    throw InputError(*obstacle);
  return begin_analysis(packing, options);
}

}  // namespace

std::optional<std::string> obstacle_to_dealing(const AnalyzeOptions& options, int contacts) {
  if (options.estimate) return "estimates of all contacts rest on one calibration, and take seconds";
  if (options.exactness == AnalyzeOptions::Exactness::kEverywhere)
    return "exact arithmetic settles all values together";
  if (options.contacts.kind == ContactChoice::Kind::kSample)
    return "a sample of contacts is drawn to be small; a list of contacts can be dealt";
  if (options.states.contacts == StateChoice::Contacts::kLargest)
    return "which contacts are the largest follows from all values, which no part has; a list of contacts "
           "can "
           "be dealt";
  if (options.method) {
    if (*options.method == Method::kBarrier) return {};
    return kNeedsBarrier;
  }
  const MethodChoice choice = choose_method(contacts, limited(options.states, contacts));
  if (choice.method == Method::kBarrier) return {};
  return fmt::format("ranges of {} are found by linear programs here ({}), and {}",
                     counted(contacts, "contact"), choice.reason, kNeedsBarrier);
}

DealtAnalysis::DealtAnalysis(const Packing& packing, const AnalyzeOptions& options)
    : start_(begin(packing, options)), contacts_(chosen_contacts(options.contacts, packing.contact_count())) {
  if (const auto defect = options.states.defect(contacts_)) throw InputError(*defect);
  const ForcePolytope& polytope = start_.polytope;
  if (polytope.status == PolytopeStatus::kEmpty)
    throw InputError(
        "no state of this packing is admissible, so that there are no ranges to deal; indet analyze "
        "without --out shows what moves");
  if (start_.choice.method != Method::kBarrier) {
    const bool has_no_states =
        polytope.status == PolytopeStatus::kUnbounded && start_.kept.kind != StateChoice::Kind::kNone;
    throw InputError(fmt::format("{}, and linear programs, which find its ranges then, are not dealt{}",
                                 start_.choice.reason,
                                 has_no_states ? "; --method barrier without extremal states may do" : ""));
  }
  if (may_be_left_to_programs(polytope))
    throw InputError(
        "some contact forces can grow without limit in this small packing, and linear programs, "
        "which may have to find its ranges then, are not dealt");
  analysis_.emplace(packing, start_, contacts_, CentralWidths(), options);
}

ForceRanges DealtAnalysis::find(const std::vector<int>& contacts, int threads,
                                const ProgressCallback& progress) const {
  ContactRequest request;
  request.choice = ContactChoice::Kind::kList;
  request.requested = static_cast<int>(contacts.size());
  std::optional<ForceRanges> ranges = analysis_->find(contacts, request, threads, progress);
  if (!ranges) throw LibraryError("values of a dealt packing were left to linear programs");
  return std::move(*ranges);
}

}  // namespace indet
