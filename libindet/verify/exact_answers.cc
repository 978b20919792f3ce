#include "libindet/verify/exact_answers.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "libindet/exact/structure.h"

namespace indet {
namespace {

/// States that show which edges are open; a few have most of them.
constexpr Eigen::Index kMostKnown = 16;

}  // namespace

const ExactCheck& ExactAnswers::check() const {
  if (!check_) check_ = check_exactly(packing_, ranges_);
  return *check_;
}

bool ExactAnswers::agree_on_value(int contact, int column) const {
  return ranges_.exact && check().lower(contact, column) == ranges_.lower(contact, column) &&
         check().upper(contact, column) == ranges_.upper(contact, column);
}

bool ExactAnswers::agree_on_reaction(Eigen::Index row, int end) const {
  return ranges_.exact && check().reactions.lower(row, end) == ranges_.reactions.lower(row, end) &&
         check().reactions.upper(row, end) == ranges_.reactions.upper(row, end);
}

void ExactAnswers::check_structure(Comparisons& compare) const {
  const exact::ContactProblem problem(packing_);
  std::vector<std::shared_ptr<const exact::ContactBasis>> known;
  for (Eigen::Index row = 0; row < std::min(kMostKnown, ranges_.states.rows()); ++row) {
    const Eigen::VectorXd state = ranges_.states.row(row).transpose();
    const std::vector<std::int32_t> zero(ranges_.active.row(row).begin(), ranges_.active.row(row).end());
    known.push_back(exact::basis_at(packing_, problem,
                                    std::span(state.data(), static_cast<std::size_t>(state.size())), zero));
  }
  if (known.empty() || !known.front()) {
    const std::vector<double> any(static_cast<std::size_t>(problem.edges()), 0);
    known.insert(known.begin(), exact::ContactBasis::create(problem, problem.choose_basis(any)));
  }
  exact::Work work(problem, std::numeric_limits<double>::infinity());
  const exact::Structure found = exact::find_structure(problem, known.front(), work, known);
  const std::optional<bool> is_bounded =
      found.verdict == exact::Verdict::kOptimal ? exact::is_bounded(found, work) : std::nullopt;
  if (found.verdict == exact::Verdict::kUndecided ||
      (found.verdict == exact::Verdict::kOptimal && !is_bounded))
    return compare.leave_unchecked("status, dim and blocks (exact arithmetic does not decide them in time)");
  if (!compare.require(is_bounded.has_value(), "status {}, but no state is admissible",
                       to_string(ranges_.status)))
    return;
  const PolytopeStatus status = found.dim == 0 ? PolytopeStatus::kPoint
                                : *is_bounded  ? PolytopeStatus::kBounded
                                               : PolytopeStatus::kUnbounded;
  compare.require(ranges_.status == status, "status: {} is stored, {} is right", to_string(ranges_.status),
                  to_string(status));
  compare.equal_count(ranges_.dim, found.dim, "dim");
  compare.equal_count(ranges_.blocks, found.parts, "blocks");
}

}  // namespace indet
