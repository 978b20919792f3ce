#include "libindet/range/exact_ranges.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "libindet/base/constants.h"
#include "libindet/base/error.h"
#include "libindet/base/tolerances.h"
#include "libindet/base/worker_team.h"
#include "libindet/exact/body_motion.h"
#include "libindet/exact/certificate.h"
#include "libindet/exact/extremal_state.h"
#include "libindet/exact/structure.h"
#include "libindet/range/drop_states.h"
#include "libindet/range/sensitivity.h"

namespace indet {
namespace {

using exact::ContactBasis;
using exact::ContactProblem;
using exact::Goal;
using exact::Optimum;
using exact::Verdict;
using SharedBasis = std::shared_ptr<const ContactBasis>;

/// The work was over.
struct Unsettled {};

std::span<const double> view_of(const Eigen::VectorXd& vector) {
  return {vector.data(), static_cast<std::size_t>(vector.size())};
}

Eigen::VectorXd rounded_state(const ContactBasis& basis) {
  const std::vector<double> forces = basis.nearest_forces();
  return Eigen::Map<const Eigen::VectorXd>(forces.data(), std::ssize(forces));
}

std::int32_t append(Rows<double>& rows, const Eigen::VectorXd& row) {
  rows.conservativeResize(rows.rows() + 1, Eigen::NoChange);
  rows.bottomRows(1) = row.transpose();
  return static_cast<std::int32_t>(rows.rows() - 1);
}

class ExactFinder {
 public:
  ExactFinder(const Packing& packing, const std::vector<int>& contacts, const StateChoice& kept,
              const ForceRanges& found, const ExactOptions& options)
      : packing_(packing),
        contacts_(contacts),
        found_(found),
        options_(options),
        problem_(packing),
        work_(problem_, options.most_work),
        problem_summary_(found),
        sums_(options.reactions ? reaction_sums(packing) : std::vector<ReactionSum>()) {
    const Eigen::Index count = packing.contact_count();
    static_cast<SearchWork&>(extrema_) = found;
    extrema_.claim.setConstant(count, 4, Outcome::kNotRequested);
    extrema_.vertex.setConstant(count, 4, -1);
    extrema_.ray.setConstant(count, 4, -1);
    extrema_.unique.setZero(count, 4);
    extrema_.clear(count);
    extrema_.state_kind = kept.kind == StateChoice::Kind::kNone ? StateChoice::Kind::kCanonical : kept.kind;
    extrema_.states.resize(0, 2 * count);
    extrema_.rays.resize(0, 2 * count);
    extrema_.active.resize(0, 0);
    extrema_.determined = 0;
    for (auto* table : {&extrema_.dual_residual, &extrema_.ray_residual}) table->setConstant(count, 4, kNaN);
    for (auto* table : {&enclosures_.lower, &enclosures_.upper}) table->setConstant(count, 4, kNaN);
    enclosures_.sensitivity.clear(count);
    enclosures_.proven = true;
    const auto sums = static_cast<Eigen::Index>(sums_.size());
    reactions_.body.resize(sums);
    reactions_.component.resize(sums);
    for (Eigen::Index k = 0; k < sums; ++k) {
      reactions_.body[k] = sums_[static_cast<std::size_t>(k)].body.code();
      reactions_.component[k] = sums_[static_cast<std::size_t>(k)].component;
    }
    for (auto* table : {&reactions_.value, &reactions_.lower, &reactions_.upper})
      table->setConstant(sums, 2, kNaN);
    reactions_.outcome.setConstant(sums, 2, Outcome::kNotRequested);
    for (auto* table : {&reactions_.vertex, &reactions_.ray}) table->setConstant(sums, 2, -1);
    for (auto* rows : {&reactions_.states, &reactions_.rays}) rows->resize(0, 2 * count);
  }

  /// Throws Unsettled.
  ForceRanges run() {
    // Each objective takes a solve at least.
    const bool is_empty = found_.status == PolytopeStatus::kEmpty;
    const auto objectives =
        is_empty ? 1 : std::max<std::int64_t>(1, 4 * std::ssize(contacts_) + 2 * reactions_.count());
    if (work_.pivots() < objectives) throw Unsettled();
    problem_summary_.exact = true;
    problem_summary_.rank = problem_.rank();
    problem_summary_.nullity = problem_summary_.unknowns - problem_.rank();
    if (!exact::proves_rank(problem_)) throw Unsettled();
    structure_ = exact::find_structure(problem_, first_basis(), work_, some_bases());
    if (structure_.verdict == Verdict::kUndecided) throw Unsettled();
    if (structure_.verdict == Verdict::kOptimal) {
      describe();
      find_all();
      describe_status();
      for (const int i : contacts_) {
        for (const int minimum : {kMinR, kMinT}) extrema_.determined += is_determined(i, minimum) ? 2 : 0;
      }
      write_states();
      for (Eigen::Index k = 0; k < reactions_.count(); ++k) {
        for (const int end : {0, 1}) find_reaction(k, end);
        report(2);
      }
    } else {
      describe_motion();
    }
    ForceRanges ranges = assemble(packing_, problem_summary_, found_, extrema_, enclosures_);
    ranges.reactions = std::move(reactions_);
    return ranges;
  }

 private:
  /// Of the first state of double precision, if there is any.
  SharedBasis first_basis() const {
    if (found_.states.rows() > 0) {
      if (SharedBasis basis = basis_of_found(problem_, 0)) return basis;
    }
    const std::vector<double> any(static_cast<std::size_t>(problem_.edges()), 0);
    return ContactBasis::create(problem_, problem_.choose_basis(any));
  }

  /// Those of a few states of double precision that together have every edge which one of them has: for each
  /// that is not seen yet, the state in which it is strongest.
  std::vector<SharedBasis> some_bases() const {
    const Eigen::Index states = found_.states.rows();
    std::vector<std::vector<double>> strengths;
    for (Eigen::Index row = 0; row < states; ++row) {
      const Eigen::VectorXd state = found_.states.row(row).transpose();
      strengths.push_back(exact::edge_strengths(packing_, view_of(state)));
    }
    const double least = tolerance::kExactZero * packing_.internal_force_unit();
    std::vector<bool> seen(static_cast<std::size_t>(problem_.edges()), false);
    std::vector<SharedBasis> bases;
    for (std::size_t e = 0; states > 0 && e < seen.size(); ++e) {
      if (seen[e] || !problem_.has_edge(static_cast<int>(e))) continue;
      const auto strongest =
          std::max_element(strengths.begin(), strengths.end(),
                           [e](const auto& first, const auto& second) { return first[e] < second[e]; });
      if ((*strongest)[e] <= least) continue;
      bases.push_back(basis_of_found(problem_, static_cast<int>(strongest - strengths.begin())));
      for (std::size_t other = 0; other < seen.size(); ++other)
        seen[other] = seen[other] || (*strongest)[other] > least;
    }
    return bases;
  }

  /// In an unbounded polytope some normal force is.
  void describe_status() {
    bool is_bounded = true;
    if (std::ssize(contacts_) == packing_.contact_count()) {
      is_bounded = !(extrema_.claim.col(kMaxR) == Outcome::kUnbounded).any();
    } else {
      const std::optional<bool> found = exact::is_bounded(structure_, work_);
      if (!found) throw Unsettled();
      is_bounded = *found;
    }
    problem_summary_.status = structure_.dim == 0 ? PolytopeStatus::kPoint
                              : is_bounded        ? PolytopeStatus::kBounded
                                                  : PolytopeStatus::kUnbounded;
  }

  void describe() {
    const ContactProblem& open = *structure_.open;
    if (!exact::proves_rank(open)) throw Unsettled();
    problem_summary_.dim = structure_.dim;
    problem_summary_.blocks = structure_.parts;
    problem_summary_.blocks_reason.clear();
    problem_summary_.motion.resize(0, 3);
    problem_summary_.wall_motion.resize(0, 2);
    problem_summary_.cell_motion.resize(0, 2);
    problem_summary_.bound_multipliers.resize(0);
    last_ = structure_.state;
    search_.emplace(open);
  }

  void describe_motion() {
    const auto proven = exact::find_falling_motion(problem_, structure_.motion, {}, tolerance::kExactZero);
    // Where its smallest velocities are lost in rounding, the motion proves no more as it is stored.
    const exact::BodyMotion motion = exact::on_bodies(packing_, problem_, proven.value_or(structure_.motion));
    problem_summary_.status = PolytopeStatus::kEmpty;
    problem_summary_.dim = -1;
    problem_summary_.blocks = 0;
    problem_summary_.blocks_reason.clear();
    problem_summary_.motion = motion.disks;
    problem_summary_.wall_motion = motion.walls;
    problem_summary_.cell_motion = motion.cell;
    problem_summary_.bound_multipliers = motion.bounds;
  }

  /// Objectives whose search begins at the same state of double precision, or at none.
  struct Task {
    int state = -1;
    std::vector<std::pair<int, int>> objectives;  ///< contact, column
  };

  /// What is found of one objective.
  struct Answer : exact::ExtremalState {
    int contact = 0, column = 0;
  };

  std::vector<Task> list_tasks() const {
    std::map<int, Task> tasks;
    for (const int i : contacts_) {
      for (int column = 0; column < 4; ++column) {
        const int state = found_.vertex.rows() > i ? found_.vertex(i, column) : -1;
        tasks[state].state = state;
        tasks[state].objectives.emplace_back(i, column);
      }
    }
    std::vector<Task> list;
    for (auto& [state, task] : tasks) {
      // Of no state there may be many, which had better not wait for each other.
      constexpr std::size_t kLargest = 8;
      for (std::size_t k = 0; k < task.objectives.size(); k += kLargest) {
        const auto first = task.objectives.begin() + static_cast<std::ptrdiff_t>(k);
        const auto count = static_cast<std::ptrdiff_t>(std::min(kLargest, task.objectives.size() - k));
        list.push_back({state, {first, first + count}});
      }
    }
    return list;
  }

  /// In rounds of fixed size, so that the work is counted in the same way for any number of threads.
  void find_all() {
    constexpr std::size_t kRound = 16;
    const std::vector<Task> tasks = list_tasks();
    WorkerTeam team(options_.threads);
    for (std::size_t first = 0; first < tasks.size(); first += kRound) {
      if (work_.is_over()) throw Unsettled();
      const std::size_t count = std::min(kRound, tasks.size() - first);
      std::vector<std::vector<Answer>> answers(count);
      const int pivots = work_.pivots();
      team.run(static_cast<std::int64_t>(count), [&](int, std::int64_t k) {
        answers[static_cast<std::size_t>(k)] = work_on(tasks[first + static_cast<std::size_t>(k)], pivots);
      });
      for (const auto& group : answers) {
        for (const Answer& answer : group) store(answer);
        report(std::ssize(group));
      }
    }
  }

  /// `pivots`: at most so many in a walk, less those of the walks before.
  std::vector<Answer> work_on(const Task& task, int pivots) const {
    const SharedBasis start =
        task.state >= 0 ? basis_of_found(*structure_.open, task.state) : structure_.state;
    std::vector<Answer> answers;
    for (const auto& [contact, column] : task.objectives) {
      answers.push_back(
          {search_->find(goal_of(contact, column), start ? start : structure_.state, std::max(0, pivots)),
           contact, column});
      pivots -= answers.back().pivots + 1;
    }
    return answers;
  }

  /// The basis of a state of double precision, its half-planes left out; nothing if there is none.
  SharedBasis basis_of_found(const ContactProblem& problem, int row) const {
    const Eigen::VectorXd state = found_.states.row(row).transpose();
    const std::vector<std::int32_t> zero(found_.active.row(row).begin(), found_.active.row(row).end());
    return exact::basis_at(packing_, problem, view_of(state), zero);
  }

  /// Whether double precision has certified this value.
  bool is_certain(int contact, int column) const {
    return !found_.doubtful && found_.outcome.rows() > contact &&
           is_certified(found_.outcome(contact, column));
  }

  static Goal goal_of(int contact, int column) {
    const bool is_maximum = column == kMaxR || column == kMaxT;
    return {2 * contact + (column >= kMinT ? 1 : 0), is_maximum ? 1 : -1};
  }

  void store(const Answer& answer) {
    work_.add(answer.pivots);
    const Optimum& optimum = answer.optimum;
    const int contact = answer.contact;
    const int column = answer.column;
    extrema_.pivots += answer.pivots;
    extrema_.dual_residual(contact, column) = 0;
    if (optimum.verdict == Verdict::kUnbounded) {
      extrema_.claim(contact, column) = Outcome::kUnbounded;
      extrema_.ray_residual(contact, column) = 0;
      const std::vector<double> ray = optimum.basis->ray(optimum.edge).forces;
      const auto [entry, is_new] = rays_.emplace(ray, static_cast<std::int32_t>(extrema_.rays.rows()));
      if (is_new) append(extrema_.rays, Eigen::Map<const Eigen::VectorXd>(ray.data(), std::ssize(ray)));
      extrema_.ray(contact, column) = entry->second;
      return;
    }
    if (optimum.verdict != Verdict::kOptimal || !answer.state) throw Unsettled();
    extrema_.claim(contact, column) = Outcome::kOptimal;
    extrema_.unique(contact, column) = answer.unique ? 1 : 0;
    extrema_.vertex(contact, column) = row_of_state(answer.state);
    const exact::Enclosure bounds = exact::enclose(optimum.value);
    enclosures_.lower(contact, column) = bounds.lower;
    enclosures_.upper(contact, column) = bounds.upper;
    enclosures_.sensitivity.set(contact, column, sensitivity(answer));
  }

  /// As double precision found it, if it saw the same; else no bound is known.
  Sensitivity sensitivity(const Answer& answer) const {
    const auto [contact, column] = std::pair(answer.contact, answer.column);
    const bool is_same = answer.optimum.pivots == 0 && is_certain(contact, column);
    if (!is_same || std::isnan(found_.sensitivity.value(contact, column)))
      return {kInfinity, SensitivityClaim::kBound};
    return {found_.sensitivity.value(contact, column),
            static_cast<SensitivityClaim>(found_.sensitivity.claim(contact, column))};
  }

  /// Whether both extrema of a component are the same.
  bool is_determined(int contact, int minimum) const {
    for (const int column : {minimum, minimum + 1}) {
      if (extrema_.claim(contact, column) != Outcome::kOptimal) return false;
    }
    if (enclosures_.upper(contact, minimum) < enclosures_.lower(contact, minimum + 1)) return false;
    const int component = 2 * contact + (minimum == kMinT ? 1 : 0);
    const auto at = [&](int column) {
      return bases_[static_cast<std::size_t>(extrema_.vertex(contact, column))]->force(component);
    };
    return at(minimum) == at(minimum + 1);
  }

  int row_of_state(const SharedBasis& basis) {
    const auto [entry, is_new] = numbers_.emplace(basis->edges(), static_cast<int>(states_.size()));
    if (is_new) {
      bases_.push_back(basis);
      states_.push_back(rounded_state(*basis));
    }
    return entry->second;
  }

  /// In the order in which values first point to them.
  void write_states() {
    const auto count = static_cast<Eigen::Index>(states_.size());
    extrema_.states.resize(count, 2 * packing_.contact_count());
    extrema_.active.resize(count, structure_.dim);
    std::vector<std::int32_t> number(states_.size(), -1);
    std::int32_t next_row = 0;
    for (std::int32_t& vertex : extrema_.vertex.reshaped<Eigen::RowMajor>()) {
      if (vertex < 0) continue;
      std::int32_t& row = number[static_cast<std::size_t>(vertex)];
      if (row < 0) {
        row = next_row++;
        extrema_.states.row(row) = states_[static_cast<std::size_t>(vertex)].transpose();
        Eigen::Index next = 0;
        for (const int e : structure_.open->open_edges()) {
          if (!bases_[static_cast<std::size_t>(vertex)]->is_basic(e)) extrema_.active(row, next++) = e;
        }
      }
      vertex = row;
    }
    note_states(extrema_.states, extrema_.vertex, StateChecker(packing_), extrema_);
  }

  void find_reaction(Eigen::Index k, int end) {
    const Eigen::VectorXd& coefficients = sums_[static_cast<std::size_t>(k)].coefficients;
    std::vector<std::pair<int, double>> terms;
    for (int c = 0; c < coefficients.size(); ++c) {
      if (coefficients[c] != 0) terms.emplace_back(c, coefficients[c]);
    }
    const Optimum optimum =
        exact::maximise(*structure_.open, last_, Goal(std::move(terms), end == 1 ? 1 : -1), work_.pivots());
    work_.add(optimum.pivots);
    extrema_.pivots += optimum.pivots;
    Reactions& r = reactions_;
    if (optimum.verdict == Verdict::kUnbounded) {
      r.outcome(k, end) = Outcome::kUnbounded;
      r.value(k, end) = r.lower(k, end) = r.upper(k, end) = end == 1 ? kInfinity : -kInfinity;
      r.ray(k, end) = append(r.rays, Eigen::Map<const Eigen::VectorXd>(
                                         optimum.basis->ray(optimum.edge).forces.data(), r.rays.cols()));
      return;
    }
    if (optimum.verdict != Verdict::kOptimal) throw Unsettled();
    last_ = optimum.basis;
    const exact::Enclosure bounds = exact::enclose(optimum.value);
    r.outcome(k, end) = Outcome::kOptimal;
    r.value(k, end) = exact::nearest(optimum.value);
    r.lower(k, end) = bounds.lower;
    r.upper(k, end) = bounds.upper;
    r.vertex(k, end) = append(r.states, rounded_state(*optimum.basis));
  }

  void report(std::int64_t settled) {
    settled_ += settled;
    const std::int64_t total = 4 * std::ssize(contacts_) + 2 * reactions_.count();
    if (options_.progress && !options_.progress(settled_, total)) throw Interrupted();
  }

  const Packing& packing_;
  const std::vector<int>& contacts_;
  const ForceRanges& found_;
  const ExactOptions& options_;
  ContactProblem problem_;
  exact::Work work_;
  ProblemSummary problem_summary_;
  exact::Structure structure_;
  std::vector<ReactionSum> sums_;
  std::optional<exact::ExtremalStates> search_;  ///< over structure_.open
  SharedBasis last_;                             ///< where the next reaction starts
  std::map<std::vector<int>, int> numbers_;      ///< of the edges of a basis: its state
  std::vector<SharedBasis> bases_;               ///< of each state
  std::vector<Eigen::VectorXd> states_;
  std::map<std::vector<double>, std::int32_t> rays_;
  std::int64_t settled_ = 0;
  Extrema extrema_;
  Enclosures enclosures_;
  Reactions reactions_;
};

}  // namespace

std::optional<ForceRanges> find_exact_ranges(const Packing& packing, const std::vector<int>& contacts,
                                             const StateChoice& kept, const ForceRanges& found,
                                             const ExactOptions& options) {
  try {
    return drop_states(ExactFinder(packing, contacts, kept, found, options).run(), kept);
  } catch (const Unsettled&) {
    return {};
  }
}

}  // namespace indet
