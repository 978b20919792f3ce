#include "libindet/verify/exact_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "libindet/base/constants.h"
#include "libindet/base/error.h"
#include "libindet/base/worker_team.h"
#include "libindet/exact/optimum.h"

namespace indet {
namespace {

using exact::ContactBasis;
using exact::ContactProblem;
using exact::Goal;
using exact::Optimum;
using exact::Verdict;

struct ObjectiveId {
  Eigen::Index contact;
  int column;
  Goal goal() const {
    const int component = 2 * static_cast<int>(contact) + (column >= kMinT ? 1 : 0);
    return {component, column == kMaxR || column == kMaxT ? 1 : -1};
  }
};

/// Objectives that start from the same stored state or ray, or from neither.
struct Task {
  int state = -1;
  int ray = -1;
  std::vector<ObjectiveId> objectives;

  bool starts_from_stored() const { return state >= 0 || ray >= 0; }
};

struct Answer {
  ObjectiveId id;
  Optimum optimum;
  bool as_stored = false;  ///< no pivot was needed
  bool rational = false;   ///< enclosures did not decide
};

class Check {
 public:
  Check(const Packing& packing, const ForceRanges& ranges, const ExactCheckOptions& options)
      : packing_(packing), ranges_(ranges), options_(options), problem_(packing) {}

  ExactCheck run() {
    const Eigen::Index contacts = packing_.contact_count();
    report_.rank = problem_.rank();
    report_.proof.setConstant(contacts, 4, Proof::kNotAsked);
    report_.lower.setConstant(contacts, 4, ForceRanges::kNaN);
    report_.upper.setConstant(contacts, 4, ForceRanges::kNaN);
    report_.vertex.setConstant(contacts, 4, -1);
    report_.states.resize(0, 2 * contacts);
    if (ranges_.rank != report_.rank) {
      say("rank differs: {} is stored, {} is exact: equations that agree within rounding do not agree "
          "exactly",
          ranges_.rank, report_.rank);
    }
    if (ranges_.status == PolytopeStatus::kEmpty) {
      check_emptiness();
    } else {
      check_objectives();
      report_.reactions =
          check_reactions_exactly(packing_, ranges_, problem_, options_, [&] { return has_solution(); });
      report_.add(report_.reactions);
    }
    return std::move(report_);
  }

 private:
  template <class... Parts>
  void say(fmt::format_string<Parts...> text, Parts&&... parts) {
    report_.add_message(fmt::format(text, std::forward<Parts>(parts)...));
  }

  std::vector<double> no_preference() const {
    return std::vector<double>(static_cast<std::size_t>(problem_.edges()), 0);
  }

  std::shared_ptr<const ContactBasis> basis_by(const std::vector<double>& preference) const {
    return ContactBasis::create(problem_, problem_.choose_basis(preference));
  }

  std::shared_ptr<const ContactBasis> basis_of_state(int state) const {
    std::vector<std::int32_t> active(ranges_.active.row(state).begin(), ranges_.active.row(state).end());
    std::sort(active.begin(), active.end());
    std::vector<int> rest;
    for (int e = 0; e < problem_.edges(); ++e) {
      if (problem_.has_edge(e) && !std::binary_search(active.begin(), active.end(), e)) rest.push_back(e);
    }
    if (static_cast<int>(rest.size()) == problem_.rank()) {
      if (std::shared_ptr<const ContactBasis> basis = ContactBasis::create(problem_, rest)) return basis;
    }
    const Eigen::VectorXd forces = ranges_.states.row(state).transpose();
    return exact::basis_at(packing_, problem_, {forces.data(), static_cast<std::size_t>(forces.size())},
                           active);
  }

  void check_emptiness() {
    // Contacts that the motion opens cannot carry force in a certificate; those that it leaves alone come
    // first.
    std::vector<double> preference = no_preference();
    const bool has_motion = ranges_.motion.rows() == packing_.disk_count();
    const std::vector<ForceBound> bounds = force_bounds(packing_);
    const bool has_multipliers = ranges_.bound_multipliers.size() == static_cast<Eigen::Index>(bounds.size());
    // What bounds add to the power of a force: R of contact α is component 2α, T is 2α + 1.
    std::vector<double> of_bounds(2 * packing_.contacts.size(), 0);
    for (std::size_t k = 0; has_multipliers && k < bounds.size(); ++k) {
      const double multiplier = ranges_.bound_multipliers[static_cast<Eigen::Index>(k)];
      of_bounds[static_cast<std::size_t>(bounds[k].component())] += multiplier;
      if (bounds[k].half_plane >= 0)
        preference[static_cast<std::size_t>(bounds[k].half_plane)] = -std::abs(multiplier);
    }
    const double length = packing_.stress.is_imposed() ? packing_.cell_length() : 1;
    for (int e = 0; has_motion && e < 2 * packing_.contact_count(); ++e) {
      const Contact& contact = packing_[ContactId(e / 2)];
      const double mu = e % 2 == 0 ? contact.mu : -contact.mu;
      const Vector2 force = contact.normal + mu * contact.tangent();
      const auto power = [&](DiskId disk, double side, double lever) {
        const auto v = ranges_.motion.row(disk.value());
        return side * (force.x() * v[0] + force.y() * v[1]) + mu * v[2] * lever / packing_[disk].radius;
      };
      double total = power(contact.a, 1, packing_.lever_a(ContactId(e / 2)));
      if (!contact.b.is_wall()) {
        total += power(contact.b.disk_id(), -1, packing_.lever_b(ContactId(e / 2)));
      } else if (ranges_.wall_motion.rows() == packing_.wall_count()) {
        const auto v = ranges_.wall_motion.row(contact.b.wall_id().value());
        total -= v[0] + mu * v[1];
      }
      const auto R = static_cast<std::size_t>(e - e % 2);
      total += of_bounds[R] + mu * of_bounds[R + 1];
      if (ranges_.cell_motion.rows() == 2)
        total -= force.dot(ranges_.cell_motion * packing_.branch(contact)) / length;
      preference[static_cast<std::size_t>(e)] = -std::abs(total);
    }
    const auto basis = basis_by(preference);
    Verdict verdict = Verdict::kUndecided;
    if (basis) {
      const Optimum answer = exact::find_solution(problem_, basis, 10 * options_.pivot_limit);
      verdict = answer.verdict;
      report_.pivots = answer.pivots;
    }
    report_.proves_emptiness = verdict == Verdict::kEmpty || verdict == Verdict::kInconsistent;
    ++(report_.proves_emptiness         ? report_.proven
       : verdict == Verdict::kUndecided ? report_.undecided
                                        : report_.refuted);
    if (verdict == Verdict::kUndecided)
      say("emptiness is neither proven nor refuted within the limit of pivots");
    if (verdict == Verdict::kOptimal) say("there are admissible states, though none is stored");
  }

  std::vector<Task> list_tasks() const {
    std::map<std::pair<int, int>, Task> tasks;
    for (Eigen::Index i = 0; i < ranges_.outcome.rows(); ++i) {
      for (int column = 0; column < 4; ++column) {
        if (is_left_out(ranges_.outcome(i, column))) continue;
        const int state = ranges_.vertex(i, column);
        const int ray = state < 0 ? ranges_.ray(i, column) : -1;
        Task& task = tasks[{state, ray}];
        task.state = state;
        task.ray = ray;
        task.objectives.push_back({i, column});
      }
    }
    std::vector<Task> list;
    for (auto& [key, task] : tasks) list.push_back(std::move(task));
    return list;
  }

  std::vector<Answer> work(const Task& task) const {
    std::shared_ptr<const ContactBasis> start;
    if (task.state >= 0) {
      start = basis_of_state(task.state);
    } else if (task.ray >= 0) {
      const Eigen::VectorXd ray = ranges_.rays.row(task.ray).transpose();
      start = basis_by(exact::edge_growths(packing_, {ray.data(), static_cast<std::size_t>(ray.size())}));
    } else {
      start = basis_by(no_preference());
    }
    std::vector<Answer> answers;
    for (const ObjectiveId& id : task.objectives) {
      Answer answer{id, {}, false, false};
      if (start) answer.optimum = exact::maximise(problem_, start, id.goal(), options_.pivot_limit);
      answer.rational = answer.optimum.basis && answer.optimum.is_rational();
      answer.as_stored = answer.optimum.pivots == 0 && task.starts_from_stored();
      answers.push_back(std::move(answer));
    }
    return answers;
  }

  void check_objectives() {
    const std::vector<Task> tasks = list_tasks();
    WorkerTeam team(options_.threads);
    // Rounds keep few exact solutions in memory, and let the caller interrupt.
    const std::size_t round = static_cast<std::size_t>(4 * std::max(1, options_.threads));
    for (std::size_t first = 0; first < tasks.size(); first += round) {
      const std::size_t count = std::min(round, tasks.size() - first);
      std::vector<std::vector<Answer>> answers(count);
      team.run(static_cast<std::int64_t>(count), [&](int, std::int64_t k) {
        answers[static_cast<std::size_t>(k)] = work(tasks[first + static_cast<std::size_t>(k)]);
      });
      for (const auto& group : answers) {
        for (const Answer& answer : group) record(answer);
      }
      const auto done = static_cast<std::int64_t>(first + count);
      if (options_.progress &&
          !options_.progress({"exact arithmetic", done, static_cast<std::int64_t>(tasks.size()), {}}))
        throw Interrupted();
    }
    write_states();
  }

  /// Whether the exact problem has a solution at all; asked only where no state has shown it.
  bool has_solution() {
    if (!solvable_) {
      const auto basis = basis_by(no_preference());
      solvable_ = basis && exact::find_solution(problem_, basis, 10 * options_.pivot_limit).verdict ==
                               Verdict::kOptimal;
    }
    return *solvable_;
  }

  int number_of(const Optimum& optimum) {
    const auto [entry, is_new] = numbers_.emplace(optimum.basis->edges(), static_cast<int>(rows_.size()));
    if (is_new) {
      const std::vector<double> state = optimum.basis->nearest_forces();
      rows_.push_back(Eigen::Map<const Eigen::VectorXd>(state.data(), std::ssize(state)));
      std::vector<std::int32_t> zero;
      for (int e = 0; e < problem_.edges(); ++e) {
        if (problem_.has_edge(e) && !optimum.basis->is_basic(e)) zero.push_back(e);
      }
      report_.zero_edges.push_back(std::move(zero));
    }
    return entry->second;
  }

  void record(const Answer& answer) {
    const auto [i, column] = answer.id;
    const double stored = ranges_.value(i, column);
    const Outcome outcome = ranges_.outcome(i, column);
    const bool certified = is_certified(outcome);
    const std::string place = fmt::format("contact {} {}", i, to_string(static_cast<Column>(column)));
    report_.pivots += answer.optimum.pivots;
    report_.rational += answer.rational ? 1 : 0;
    Proof& proof = report_.proof(i, column);
    proof = Proof::kUndecided;
    switch (answer.optimum.verdict) {
      case Verdict::kOptimal: {
        solvable_ = true;
        const exact::Enclosure exact_value = exact::enclose(answer.optimum.value);
        report_.lower(i, column) = exact_value.lower;
        report_.upper(i, column) = exact_value.upper;
        report_.vertex(i, column) = number_of(answer.optimum);
        proof = std::isinf(stored) ? Proof::kRefuted : answer.as_stored ? Proof::kProven : Proof::kRepaired;
        if (std::isfinite(stored)) {
          const mpq_class error =
              abs(mpq_class(stored) - answer.optimum.value) / mpq_class(ranges_.force_unit);
          report_.worst_error = std::max(report_.worst_error, error.get_d());
          if (certified)
            report_.worst_certified_error = std::max(report_.worst_certified_error, error.get_d());
        }
        const bool inside = contains(i, column, answer.optimum.value);
        if (certified && !inside) {
          ++report_.contradictions;
          say("{}: the exact value {:.17g} is outside of the stored bounds [{:.17g}, {:.17g}]", place,
              exact_value.lower, ranges_.lower(i, column), ranges_.upper(i, column));
        }
        if (proof == Proof::kRefuted)
          say("{}: stored as unbounded, but the exact value is {:.17g}", place, exact_value.lower);
        break;
      }
      case Verdict::kUnbounded: {
        const double infinite = answer.id.goal().sign * kInfinity;
        report_.lower(i, column) = report_.upper(i, column) = infinite;
        if (!has_solution()) break;
        proof = stored == infinite   ? (answer.as_stored ? Proof::kProven : Proof::kRepaired)
                : std::isnan(stored) ? Proof::kRepaired
                                     : Proof::kRefuted;
        if (proof == Proof::kRefuted) {
          say("{}: {:.17g} is stored, but it is unbounded", place, stored);
          const double bound = infinite > 0 ? ranges_.upper(i, column) : ranges_.lower(i, column);
          if (certified && bound != infinite) ++report_.contradictions;
        }
        break;
      }
      case Verdict::kEmpty:
      case Verdict::kInconsistent:
        proof = Proof::kRefuted;
        say("{}: exactly, the packing has no admissible state", place);
        break;
      case Verdict::kUndecided:
        say("{}: not decided within {} exact pivots", place, answer.optimum.pivots);
        break;
    }
    report_.count(proof);
  }

  bool contains(Eigen::Index i, int column, const mpq_class& value) const {
    return exact::contains({ranges_.lower(i, column), ranges_.upper(i, column)}, value);
  }

  void write_states() {
    report_.states.resize(static_cast<Eigen::Index>(rows_.size()), 2 * packing_.contact_count());
    for (std::size_t k = 0; k < rows_.size(); ++k)
      report_.states.row(static_cast<Eigen::Index>(k)) = rows_[k].transpose();
  }

  const Packing& packing_;
  const ForceRanges& ranges_;
  const ExactCheckOptions& options_;
  ContactProblem problem_;
  ExactCheck report_;
  std::optional<bool> solvable_;
  std::map<std::vector<int>, int> numbers_;
  std::vector<Eigen::VectorXd> rows_;
};

}  // namespace

ExactCheck check_exactly(const Packing& packing, const ForceRanges& ranges,
                         const ExactCheckOptions& options) {
  return Check(packing, ranges, options).run();
}

}  // namespace indet
