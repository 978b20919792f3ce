#include "libindet/range/canonical_states.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>
#include <vector>

#include "libindet/base/tolerances.h"
#include "libindet/lp/vertex.h"

namespace indet {
namespace {

/// The part of a face on which a functional is largest.
struct Face {
  std::vector<int> held;  ///< inequalities that are zero on it; ascending
  bool is_point = true;   ///< the vertex alone, where it is not degenerate
};

/// From the vertex at which the functional is largest on the face of `held`.
Face optimal_part(const Vertex& vertex, const Objective& functional, const std::vector<int>& held) {
  const Eigen::VectorXd costs = vertex.multipliers(functional);
  Face face{held, true};
  for (Eigen::Index k = 0; k < costs.size(); ++k) {
    const int inequality = vertex.basis[static_cast<std::size_t>(k)];
    if (std::binary_search(held.begin(), held.end(), inequality)) continue;
    if (costs[k] > tolerance::kReducedCost) {
      face.held.push_back(inequality);
    } else {
      face.is_point = false;
    }
  }
  std::sort(face.held.begin(), face.held.end());
  return face;
}

}  // namespace

bool CanonicalStates::is_open(const ObjectiveProgress& known) {
  return known.wanted && known.optimal && !known.canonical && !known.stateless &&
         known.dual_residual <= tolerance::kReducedCost;
}

TaskResult CanonicalStates::find(Maximiser& solver, std::int64_t objective) const {
  const ObjectiveProgress& known = table_[objective];
  TaskResult result;
  result.objective = objective;
  Face face{known.held, false};
  Vertex vertex;
  vertex.basis = table_.best_basis(objective);
  for (const Objective* functional : {&checker_.lightness(), &checker_.generic()}) {
    const LpAnswer answer = solver.maximise(*functional, vertex.basis, face.held);
    result.work.add(answer);
    if (answer.status != LpStatus::kOptimal) return result;
    if (functional == &checker_.lightness() || answer.basis != vertex.basis)
      vertex = locate_vertex(view_, answer.basis);
    face = optimal_part(vertex, *functional, face.held);
    if (face.is_point) break;
  }
  result.status = LpStatus::kOptimal;
  result.found = checker_.evaluate(std::move(vertex));
  result.verdicts = checker_.judge(table_.candidates(*result.found), *result.found);
  result.settles_state = true;
  result.unique = !checker_.has_free_polytope_edge(*result.found, known.held) &&
                  is_point(solver, result.found->vertex, known.held, result.work);
  return result;
}

/// True if the face {x_k = 0, k ∈ held} is the given vertex alone: the generic functional is constant on it.
/// Asked only at degenerate vertices.
bool CanonicalStates::is_point(Maximiser& solver, const Vertex& vertex, const std::vector<int>& held,
                               SolverWork& work) const {
  Objective opposite = checker_.generic();
  opposite.along_z *= -1;
  for (auto& [index, coefficient] : opposite.on_edges) coefficient *= -1;
  std::vector<double> values;
  for (const Objective* functional :
       std::initializer_list<const Objective*>{&checker_.generic(), &opposite}) {
    const LpAnswer answer = solver.maximise(*functional, vertex.basis, held);
    work.add(answer);
    if (answer.status != LpStatus::kOptimal) return false;
    const Vertex end = answer.basis == vertex.basis ? vertex : locate_vertex(view_, answer.basis);
    double value = 0;
    for (const auto& [k, coefficient] : checker_.generic().on_edges) value += coefficient * end.x[k];
    values.push_back(value);
  }
  return std::abs(values[0] - values[1]) <= tolerance::kPointFace * std::max(1.0, std::abs(values[0]));
}

}  // namespace indet
