#include "libindet/exact/structure.h"

#include <algorithm>
#include <set>
#include <utility>

#include "libindet/base/disjoint_sets.h"

namespace indet::exact {
namespace {

/// Sets those edges that have a strength.
void mark_open(const ContactBasis& state, const std::vector<int>& edges, std::vector<bool>& open) {
  for (const int e : edges) {
    if (state.sign_of_strength(e) > 0) open[static_cast<std::size_t>(e)] = true;
  }
}

/// The edges that have a strength in some state, found by ever larger sums of strengths; in the last one, of
/// the edges that have none, no state has any. Nothing if the work is over. `state` becomes a basis of a
/// state.
std::optional<std::vector<bool>> find_open(const ContactProblem& problem,
                                           std::span<const std::shared_ptr<const ContactBasis>> known,
                                           std::shared_ptr<const ContactBasis>& state, Work& work) {
  std::vector<bool> open(static_cast<std::size_t>(problem.edges()), false);
  const std::vector<int> edges = problem.open_edges();
  for (const auto& basis : known) {
    if (basis && basis->is_balanced() && basis->first_negative() < 0) mark_open(*basis, edges, open);
  }
  for (;;) {
    mark_open(*state, edges, open);
    std::vector<std::pair<int, double>> rest;
    for (const int e : edges) {
      if (!open[static_cast<std::size_t>(e)]) rest.emplace_back(e, 1.0);
    }
    if (rest.empty()) return open;
    const Goal goal = Goal::of_strengths(std::move(rest));
    const Optimum found = maximise(problem, state, goal, work.pivots());
    work.add(found.pivots);
    if (found.verdict == Verdict::kUnbounded) {
      const ContactBasis::Ray ray = found.basis->ray(found.edge);
      for (std::size_t e = 0; e < open.size(); ++e) open[e] = open[e] || ray.grows[e];
    } else if (found.verdict == Verdict::kOptimal) {
      state = found.basis;
      if (found.value == 0) return open;
    } else {
      return {};
    }
  }
}

/// Edges e outside of a basis and those of the basis whose strengths change with e, modulo a prime.
int count_parts(const ContactProblem& problem, const ContactBasis& basis) {
  std::vector<IntegerColumn> columns;
  for (const int e : basis.edges()) columns.push_back(problem.on_independent_rows(problem.edge(e)));
  std::vector<const IntegerColumn*> pointers;
  for (const IntegerColumn& column : columns) pointers.push_back(&column);
  const PrimeField field(large_prime(0));
  const ModularLu lu(field, problem.rank(), pointers);
  DisjointSets sets(problem.edges());
  std::vector<bool> moves(static_cast<std::size_t>(problem.edges()), false);
  for (const int e : problem.open_edges()) {
    if (basis.is_basic(e)) continue;
    moves[static_cast<std::size_t>(e)] = true;
    const IntegerColumn column = problem.on_independent_rows(problem.edge(e));
    std::vector<std::uint64_t> right(static_cast<std::size_t>(problem.rank()), 0);
    for (std::size_t k = 0; k < column.row.size(); ++k)
      right[static_cast<std::size_t>(column.row[k])] = field.reduce(column.value[k]);
    const std::vector<std::uint64_t> change = lu.solve(std::move(right));
    for (std::size_t k = 0; k < change.size(); ++k) {
      if (change[k] == 0) continue;
      moves[static_cast<std::size_t>(basis.edges()[k])] = true;
      sets.join(e, basis.edges()[k]);
    }
  }
  for (int contact = 0; contact < problem.contacts(); ++contact) {
    const auto plus = static_cast<std::size_t>(2 * contact);
    if (moves[plus] && moves[plus + 1]) sets.join(plus, plus + 1);
  }
  std::set<std::size_t> roots;
  for (int e = 0; e < problem.edges(); ++e) {
    if (moves[static_cast<std::size_t>(e)]) roots.insert(sets.root(e));
  }
  return static_cast<int>(roots.size());
}

/// A basis of fewer edges, at the same state.
std::shared_ptr<const ContactBasis> basis_of(const ContactProblem& open, const ContactBasis& state) {
  std::vector<double> preference(static_cast<std::size_t>(open.edges()), 0);
  for (const int e : state.edges()) preference[static_cast<std::size_t>(e)] = 1 + state.sign_of_strength(e);
  return ContactBasis::create(open, open.choose_basis(preference));
}

}  // namespace

std::optional<bool> is_bounded(const Structure& structure, Work& work) {
  std::vector<std::pair<int, double>> all;
  for (const int e : structure.open->open_edges()) all.emplace_back(e, 1.0);
  const Optimum largest =
      maximise(*structure.open, structure.state, Goal::of_strengths(std::move(all)), work.pivots());
  work.add(largest.pivots);
  if (largest.verdict != Verdict::kOptimal && largest.verdict != Verdict::kUnbounded) return {};
  return largest.verdict == Verdict::kOptimal;
}

Structure find_structure(const ContactProblem& problem, std::shared_ptr<const ContactBasis> start, Work& work,
                         std::span<const std::shared_ptr<const ContactBasis>> known) {
  Structure result;
  if (!start) return result;
  const Optimum first = find_solution(problem, std::move(start), work.pivots());
  work.add(first.pivots);
  if (first.verdict == Verdict::kEmpty) result.motion = first.basis->falling_motion(first.edge);
  if (first.verdict == Verdict::kInconsistent) result.motion = *first.basis->contradiction();
  if (first.verdict != Verdict::kOptimal) {
    result.verdict = first.verdict;
    return result;
  }
  std::shared_ptr<const ContactBasis> state = first.basis;
  const auto open = find_open(problem, known, state, work);
  if (!open) return result;
  result.open = std::make_shared<const ContactProblem>(problem.restricted_to(*open));
  result.state = basis_of(*result.open, *state);
  if (!result.state) return result;
  const std::vector<int> edges = result.open->open_edges();
  result.dim = static_cast<int>(edges.size()) - result.open->rank();
  result.parts = count_parts(*result.open, *result.state);
  result.verdict = Verdict::kOptimal;
  return result;
}

}  // namespace indet::exact
