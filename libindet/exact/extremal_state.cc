#include "libindet/exact/extremal_state.h"

#include <optional>

#include "libindet/base/random.h"

namespace indet::exact {
namespace {

/// −ΣR.
Goal lightness_of(const ContactProblem& problem) {
  std::vector<std::pair<int, double>> normal_forces;
  for (int i = 0; i < problem.contacts(); ++i) normal_forces.emplace_back(2 * i, 1.0);
  return {std::move(normal_forces), -1};
}

/// Weights in [1, 2), so that no two states of a face tie.
Goal generic_of(const ContactProblem& problem) {
  Random random(1);
  std::vector<std::pair<int, double>> weights;
  for (const int e : problem.open_edges()) weights.emplace_back(e, -random.uniform(1, 2));
  return Goal::of_strengths(std::move(weights));
}

}  // namespace

ExtremalStates::ExtremalStates(const ContactProblem& problem)
    : problem_(problem), lightness_(lightness_of(problem)), generic_(generic_of(problem)) {}

ExtremalState ExtremalStates::find(const Goal& goal, std::shared_ptr<const ContactBasis> start,
                                   int limit) const {
  ExtremalState found;
  found.optimum = maximise(problem_, std::move(start), goal, limit);
  found.pivots = found.optimum.pivots;
  if (found.optimum.verdict != Verdict::kOptimal) return found;
  const auto& basis = found.optimum.basis;
  const Face face = basis->optimal_face(goal, *found.optimum.multipliers);
  const std::optional<bool> is_one = has_one_state(basis, face, limit, found.pivots);
  if (!is_one) return found;
  found.unique = *is_one;
  found.state = *is_one ? basis : canonical(basis, face, limit, found.pivots);
  return found;
}

/// Whether no edge outside of the basis has a strength in any state of the face. Nothing if the limit was
/// reached.
std::optional<bool> ExtremalStates::has_one_state(const std::shared_ptr<const ContactBasis>& basis,
                                                  const Face& face, int limit, int& pivots) const {
  const std::vector<int> outside = basis->outside(face);
  if (outside.empty()) return true;
  ++pivots;
  if (basis->can_grow(outside.front())) return false;
  std::vector<std::pair<int, double>> sum;
  for (const int e : outside) sum.emplace_back(e, 1.0);
  const Optimum most = maximise(problem_, basis, Goal::of_strengths(std::move(sum)), limit, face);
  pivots += most.pivots + 1;
  if (most.verdict == Verdict::kUnbounded) return false;
  if (most.verdict != Verdict::kOptimal) return {};
  return most.value == 0;
}

std::shared_ptr<const ContactBasis> ExtremalStates::canonical(
    const std::shared_ptr<const ContactBasis>& start, const Face& face, int limit, int& pivots) const {
  const Optimum light = maximise(problem_, start, lightness_, limit, face);
  pivots += light.pivots + 1;
  if (light.verdict != Verdict::kOptimal) return nullptr;
  const Face lightest = light.basis->optimal_face(lightness_, *light.multipliers, face);
  if (light.basis->outside(lightest).empty()) return light.basis;
  const Optimum chosen = maximise(problem_, light.basis, generic_, limit, lightest);
  pivots += chosen.pivots + 1;
  return chosen.verdict == Verdict::kOptimal ? chosen.basis : nullptr;
}

}  // namespace indet::exact
