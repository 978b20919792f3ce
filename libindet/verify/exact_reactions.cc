#include "libindet/verify/exact_reactions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "libindet/base/constants.h"
#include "libindet/base/error.h"
#include "libindet/base/worker_team.h"
#include "libindet/exact/optimum.h"
#include "libindet/verify/exact_check.h"
#include "libindet/verify/rebuilt_sums.h"

namespace indet {
namespace {

using exact::ContactBasis;
using exact::Goal;
using exact::Optimum;
using exact::Verdict;

class ReactionProver {
 public:
  ReactionProver(const Packing& packing, const ForceRanges& ranges, const exact::ContactProblem& problem,
                 const ExactCheckOptions& options, const std::function<bool()>& has_solution)
      : packing_(packing),
        ranges_(ranges),
        r_(ranges.reactions),
        problem_(problem),
        options_(options),
        has_solution_(has_solution) {
    const Eigen::Index count = r_.count();
    result_.proof.setConstant(count, 2, Proof::kNotAsked);
    for (auto* table : {&result_.value, &result_.lower, &result_.upper}) table->setConstant(count, 2, kNaN);
    result_.vertex.setConstant(count, 2, -1);
    result_.states.resize(0, 2 * packing.contact_count());
  }

  ExactReactions run() {
    if (r_.count() == 0) return std::move(result_);
    const std::vector<RebuiltSum> sums = rebuilt_sums(packing_);
    bool same = std::ssize(sums) == r_.count();
    for (Eigen::Index k = 0; same && k < r_.count(); ++k) {
      const RebuiltSum& sum = sums[static_cast<std::size_t>(k)];
      same = sum.body.code() == r_.body[k] && sum.component == r_.component[k];
    }
    if (!same) {
      ++result_.contradictions;
      result_.add_message("reactions: the stored rows are not those of the packing");
      return std::move(result_);
    }
    // Rounds, as in check_exactly: both ends of a few sums at a time.
    WorkerTeam team(options_.threads);
    const std::int64_t total = 2 * static_cast<std::int64_t>(r_.count());
    const std::int64_t round = 4 * std::max(1, options_.threads);
    for (std::int64_t first = 0; first < total; first += round) {
      std::vector<Optimum> found(static_cast<std::size_t>(std::min(round, total - first)));
      team.run(std::ssize(found), [&](int, std::int64_t task) {
        const Eigen::Index k = (first + task) / 2;
        const int end = static_cast<int>((first + task) % 2);
        if (const auto start = start_of(k, end)) {
          const Goal goal = goal_of(sums[static_cast<std::size_t>(k)], end);
          found[static_cast<std::size_t>(task)] =
              exact::maximise(problem_, start, goal, options_.pivot_limit);
        }
      });
      for (std::int64_t task = 0; task < std::ssize(found); ++task)
        record((first + task) / 2, static_cast<int>((first + task) % 2),
               found[static_cast<std::size_t>(task)]);
      const std::int64_t done = std::min(first + round, total);
      if (options_.progress && !options_.progress({"exact arithmetic, reactions", done, total, {}}))
        throw Interrupted();
    }
    return std::move(result_);
  }

 private:
  static Goal goal_of(const RebuiltSum& sum, int end) {
    std::vector<std::pair<int, double>> terms;
    for (int i = 0; i < sum.coefficients.size(); ++i) {
      if (sum.coefficients[i] != 0) terms.emplace_back(i, sum.coefficients[i]);
    }
    return {std::move(terms), end == 0 ? -1 : 1};
  }

  bool starts_from_stored(Eigen::Index k, int end) const {
    return r_.vertex(k, end) >= 0 || r_.ray(k, end) >= 0;
  }

  /// A basis of the edges that are strongest in the stored state or along the stored ray.
  std::shared_ptr<const ContactBasis> start_of(Eigen::Index k, int end) const {
    std::vector<double> preference(static_cast<std::size_t>(problem_.edges()), 0);
    const bool is_state = r_.vertex(k, end) >= 0;
    if (starts_from_stored(k, end)) {
      const Eigen::VectorXd forces =
          is_state ? r_.states.row(r_.vertex(k, end)).transpose() : r_.rays.row(r_.ray(k, end)).transpose();
      const std::span<const double> values(forces.data(), static_cast<std::size_t>(forces.size()));
      preference = is_state ? exact::edge_strengths(packing_, values) : exact::edge_growths(packing_, values);
    }
    return ContactBasis::create(problem_, problem_.choose_basis(preference));
  }

  void record(Eigen::Index k, int end, const Optimum& optimum) {
    const std::string place = fmt::format("reactions: {} of row {}", end == 0 ? "minimum" : "maximum", k);
    const double stored = r_.value(k, end);
    const bool as_stored = optimum.pivots == 0 && starts_from_stored(k, end);
    const Proof agreed = as_stored ? Proof::kProven : Proof::kRepaired;
    const bool certified = is_certified(r_.outcome(k, end));
    Proof proof = Proof::kUndecided;
    result_.pivots += optimum.pivots;
    result_.rational += optimum.basis && optimum.is_rational() ? 1 : 0;
    if (optimum.verdict == Verdict::kOptimal) {
      proof = std::isinf(stored) ? Proof::kRefuted : agreed;
      take(k, end, optimum);
      if (std::isfinite(stored)) {
        const double error = mpq_class(abs(mpq_class(stored) - optimum.value)).get_d() / unit_of(k);
        result_.worst_error = std::max(result_.worst_error, error);
        if (certified) result_.worst_certified_error = std::max(result_.worst_certified_error, error);
      }
      if (certified && !exact::contains({r_.lower(k, end), r_.upper(k, end)}, optimum.value)) {
        ++result_.contradictions;
        result_.add_message(
            fmt::format("{}: the exact value {:.17g} is outside of the stored bounds [{:.17g}, {:.17g}]",
                        place, result_.value(k, end), r_.lower(k, end), r_.upper(k, end)));
      }
    } else if (optimum.verdict == Verdict::kUnbounded && has_solution_()) {
      const double infinite = end == 0 ? -kInfinity : kInfinity;
      const double bound = end == 0 ? r_.lower(k, end) : r_.upper(k, end);
      result_.value(k, end) = result_.lower(k, end) = result_.upper(k, end) = infinite;
      proof = stored == infinite || std::isnan(stored) ? agreed : Proof::kRefuted;
      if (proof == Proof::kRefuted && certified && bound != infinite) ++result_.contradictions;
    } else if (optimum.verdict == Verdict::kEmpty || optimum.verdict == Verdict::kInconsistent) {
      proof = Proof::kRefuted;
    }
    if (proof == Proof::kUndecided) {
      result_.add_message(
          optimum.verdict == Verdict::kUnbounded
              ? fmt::format("{}: it grows without limit if there is any state, which is undecided", place)
              : fmt::format("{}: not decided within {} exact pivots", place, optimum.pivots));
    } else if (proof == Proof::kRefuted) {
      result_.add_message(
          std::isnan(result_.value(k, end))
              ? fmt::format("{}: exactly, the packing has no admissible state", place)
              : fmt::format("{}: {} is stored, exactly it is {}", place, stored, result_.value(k, end)));
    }
    result_.proof(k, end) = proof;
    result_.count(proof);
  }

  /// mg in the scene's units, times the radius for a torque.
  double unit_of(Eigen::Index k) const {
    const Body body = Body::from_code(r_.body[k]);
    const bool is_torque = !body.is_wall() && r_.component[k] == 2;
    return ranges_.force_unit * (is_torque ? packing_[body.disk_id()].radius : 1);
  }

  void take(Eigen::Index k, int end, const Optimum& optimum) {
    const exact::Enclosure value = exact::enclose(optimum.value);
    result_.value(k, end) = exact::nearest(optimum.value);
    result_.lower(k, end) = value.lower;
    result_.upper(k, end) = value.upper;
    const std::vector<double> state = optimum.basis->nearest_forces();
    result_.vertex(k, end) = static_cast<std::int32_t>(result_.states.rows());
    result_.states.conservativeResize(result_.states.rows() + 1, Eigen::NoChange);
    result_.states.bottomRows(1) = Eigen::Map<const Eigen::RowVectorXd>(state.data(), std::ssize(state));
  }

  const Packing& packing_;
  const ForceRanges& ranges_;
  const Reactions& r_;
  const exact::ContactProblem& problem_;
  const ExactCheckOptions& options_;
  const std::function<bool()>& has_solution_;
  ExactReactions result_;
};

}  // namespace

ExactReactions check_reactions_exactly(const Packing& packing, const ForceRanges& ranges,
                                       const exact::ContactProblem& problem, const ExactCheckOptions& options,
                                       const std::function<bool()>& has_solution) {
  return ReactionProver(packing, ranges, problem, options, has_solution).run();
}

}  // namespace indet
