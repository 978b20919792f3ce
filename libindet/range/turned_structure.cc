#include "libindet/range/turned_structure.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <tuple>
#include <utility>

#include "libindet/base/disjoint_sets.h"
#include "libindet/base/tolerances.h"
#include "libindet/polytope/central_polytope.h"

namespace indet {

TurnedStructure::TurnedStructure(const ForcePolytope& polytope) : polytope_(polytope) {
  find_loose_contacts();
  find_closed_edges();
  find_deficiency();
}

/// A body all of whose contacts are closed hangs on its last one, once those of others like it are gone.
void TurnedStructure::find_loose_contacts() {
  const EquilibriumProblem& natural = polytope_.natural;
  const auto& modes = polytope_.problem.modes;
  loose_.assign(modes.size(), false);
  std::vector<std::vector<std::size_t>> contacts(static_cast<std::size_t>(natural.equations()));
  std::vector<int> left(contacts.size(), 0);
  for (std::size_t i = 0; i < modes.size(); ++i) {
    for (const int body : {natural.contacts[i].a, natural.contacts[i].b}) {
      if (body < 0) continue;
      contacts[static_cast<std::size_t>(body)].push_back(i);
      ++left[static_cast<std::size_t>(body)];
    }
  }
  const auto is_idle = [&](std::size_t body) {
    return std::all_of(contacts[body].begin(), contacts[body].end(),
                       [&](std::size_t i) { return modes[i] == ContactMode::kOpen; });
  };
  std::vector<std::size_t> ends;
  for (std::size_t body = 0; body < contacts.size(); ++body) {
    if (left[body] == 1 && is_idle(body)) ends.push_back(body);
  }
  while (!ends.empty()) {
    const std::size_t body = ends.back();
    ends.pop_back();
    for (const std::size_t i : contacts[body]) {
      if (loose_[i]) continue;
      loose_[i] = true;
      for (const int other : {natural.contacts[i].a, natural.contacts[i].b}) {
        if (other < 0) continue;
        const auto neighbour = static_cast<std::size_t>(other);
        if (--left[neighbour] == 1 && neighbour != body && is_idle(neighbour)) ends.push_back(neighbour);
      }
    }
  }
}

void TurnedStructure::find_closed_edges() {
  using Name = std::tuple<int, int, int>;
  const auto name_of = [](const Edge& edge) {
    return Name{edge.is_slack() ? -1 : edge.contact.value(), edge.sign, edge.bound};
  };
  std::vector<Name> open;
  for (const Edge& edge : polytope_.problem.edges) open.push_back(name_of(edge));
  std::sort(open.begin(), open.end());
  for (int k = 0; k < polytope_.natural.unknowns(); ++k) {
    const Edge& edge = polytope_.natural.edge(k);
    if (std::binary_search(open.begin(), open.end(), name_of(edge))) continue;
    if (edge.is_slack() || !loose_[static_cast<std::size_t>(edge.contact.value())]) closed_.push_back(k);
  }
  std::map<Name, int> number;
  const auto row_name = [](const EquilibriumRow& row) {
    return Name{row.bound >= 0 ? 0 : row.body.code(), row.component, row.bound};
  };
  for (int row = 0; row < polytope_.natural.equations(); ++row)
    number[row_name(polytope_.natural.rows[static_cast<std::size_t>(row)])] = row;
  for (const EquilibriumRow& row : polytope_.problem.rows)
    natural_of_row_.push_back(number.at(row_name(row)));
}

/// How many ways of rolling about their one contact there are: of a disk that rests on one contact, and of
/// the next one that rests on one once it is gone. Precondition: none of its other contacts is open.
int TurnedStructure::rolling_disks() const {
  const EquilibriumProblem& problem = polytope_.natural;
  const auto& modes = polytope_.problem.modes;
  std::vector<std::vector<std::size_t>> contacts(static_cast<std::size_t>(problem.equations()));
  std::vector<std::size_t> left(contacts.size(), 0);
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    if (loose_[i]) continue;
    for (const int body : {problem.contacts[i].a, problem.contacts[i].b}) {
      if (body < 0) continue;
      contacts[static_cast<std::size_t>(body)].push_back(i);
      ++left[static_cast<std::size_t>(body)];
    }
  }
  const auto may_roll = [&](std::size_t body) {
    return left[body] == 1 && !problem.rows[body].body.is_wall();
  };
  std::vector<std::size_t> ends;
  for (std::size_t body = 0; body < contacts.size(); ++body) {
    if (may_roll(body)) ends.push_back(body);
  }
  std::vector<bool> gone(problem.contacts.size(), false);
  int rolling = 0;
  while (!ends.empty()) {
    const std::size_t body = ends.back();
    ends.pop_back();
    if (!may_roll(body)) continue;
    for (const std::size_t i : contacts[body]) {
      if (gone[i] || modes[i] == ContactMode::kOpen) continue;
      ++rolling;
      gone[i] = true;
      for (const int end : {problem.contacts[i].a, problem.contacts[i].b}) {
        if (end < 0) continue;
        const auto other = static_cast<std::size_t>(end);
        --left[other];
        if (may_roll(other)) ends.push_back(other);
      }
    }
  }
  return rolling;
}

/// The equations may be dependent in as many ways as groups of bodies that touch nothing fixed translate, and
/// as disks roll.
void TurnedStructure::find_deficiency() {
  const EquilibriumProblem& problem = polytope_.problem;
  const int count = problem.equations();
  DisjointSets groups(count + 1);  // the last one: what is fixed
  std::vector<bool> is_body(static_cast<std::size_t>(count), false);
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    if (problem.modes[i] == ContactMode::kOpen) continue;
    const auto [a, b] = std::pair(problem.contacts[i].a, problem.contacts[i].b);
    for (const int body : {a, b}) {
      if (body >= 0) is_body[static_cast<std::size_t>(body)] = true;
    }
    groups.join(a >= 0 ? a : count, b >= 0 ? b : count);
  }
  int free_groups = 0;
  for (int body = 0; body < count; ++body) {
    const bool is_free = is_body[static_cast<std::size_t>(body)] && groups.root(body) != groups.root(count);
    free_groups += is_free && groups.root(body) == static_cast<std::size_t>(body) ? 1 : 0;
  }
  const int dense_rank = polytope_.null_space ? polytope_.null_space->rank : 0;
  const int rank = polytope_.central ? static_cast<int>(polytope_.central->rows.size()) : dense_rank;
  stays_full_ = !polytope_.doubtful && rank == count - 2 * free_groups - rolling_disks();
}

bool TurnedStructure::resists_opening(Eigen::Index contact, bool tangential, double sign,
                                      const Eigen::VectorXd& y) const {
  if (closed_.empty()) return true;
  const EquilibriumProblem& natural = polytope_.natural;
  Eigen::VectorXd all = Eigen::VectorXd::Zero(natural.equations());
  for (std::size_t row = 0; row < natural_of_row_.size(); ++row)
    all[natural_of_row_[row]] = y[static_cast<Eigen::Index>(row)];
  const double noise = tolerance::kReducedCost * std::max(1.0, all.lpNorm<Eigen::Infinity>());
  return std::all_of(closed_.begin(), closed_.end(), [&](int k) {
    const Edge& edge = natural.edge(k);
    const bool is_own = !edge.is_slack() && edge.contact.value() == contact;
    const double cost = is_own ? sign * (tangential ? edge.T : edge.R) : 0;
    return natural.edge_matrix.col(k).dot(all) >= cost - noise;
  });
}

}  // namespace indet
