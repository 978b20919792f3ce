#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "libindet/lp/feasible_set.h"
#include "libindet/lp/vertex.h"
#include "libindet/range/component.h"

namespace indet {

/// A vertex with everything that the search asks of it.
struct CheckedVertex {
  Vertex vertex;
  Eigen::VectorXd values;  ///< of all components
  double weight = 0;
  Eigen::MatrixXd state_costs;  ///< 2 × d: reduced costs of minimising weight·x, and the generic functional
  std::vector<std::optional<bool>>
      has_length;  ///< d: whether that edge of the polytope has positive length, where it was asked
};

/// What one vertex proves about one objective.
struct ObjectiveVerdict {
  std::int64_t objective = 0;
  double value = 0;        ///< signed so that larger is better
  bool optimal = false;    ///< no wrong-signed reduced cost
  bool canonical = false;  ///< … and no better state on the optimal face
  bool unique = false;     ///< all reduced costs positive
  double dual_residual = 0;
  std::vector<int> held;  ///< inequalities with positive reduced cost: they define the optimal face
};

/// Tells what a vertex proves about objectives. Objective 2c minimises component c, 2c + 1 maximises it; both
/// are posed as maxima.
///
/// Canonical states are those of smallest weight·x on the optimal face, and among equals of the smallest
/// value of a generic functional with fixed weights (docs/decisions/canonical-states.md).
class OptimalityChecker {
 public:
  /// `set`, `components` and `weight` must outlive the checker.
  OptimalityChecker(const SlopeView& view, const std::vector<Component>& components,
                    const Eigen::VectorXd& weight, bool canonical_states);

  std::int64_t objectives() const { return 2 * rows_.rows(); }
  static double sign_of(std::int64_t objective) { return objective % 2 == 0 ? -1.0 : 1.0; }
  Objective signed_objective(std::int64_t number) const;
  double value_of(std::int64_t component, const Eigen::VectorXd& x) const;

  const Objective& lightness() const { return lightness_; }  ///< maximises −weight·x
  const Objective& generic() const { return generic_; }

  /// Recomputes the vertex from its basis. Throws LibraryError if that is singular.
  CheckedVertex recompute(const Basis& basis) const { return evaluate(locate_vertex(view_, basis)); }
  CheckedVertex evaluate(Vertex vertex) const;

  /// Judges a vertex for objectives in ascending order: with the d active inequalities N, λ = −g S_N⁻¹ are
  /// the reduced costs of objective g, and λ ≥ 0 proves the vertex optimal.
  std::vector<ObjectiveVerdict> judge(std::span<const std::int64_t> objectives, CheckedVertex& checked) const;

  /// True if some edge of the polytope in its face {x_k = 0, k ∈ held} has positive length, so that the face
  /// is more than a point.
  bool has_free_polytope_edge(CheckedVertex& checked, const std::vector<int>& held) const;

 private:
  Eigen::MatrixXd changes(const std::vector<int>& rows, const Vertex& vertex) const;
  ObjectiveVerdict judge_one(std::int64_t objective, CheckedVertex& checked,
                             const Eigen::VectorXd& costs) const;
  bool polytope_edge_has_length(CheckedVertex& checked, int k) const;
  bool keeps_to(const CheckedVertex& checked, int k, const std::vector<int>& held) const;

  const SlopeView& view_;
  const std::vector<Component>& components_;
  const Eigen::VectorXd& weight_;
  bool canonical_states_;
  Eigen::MatrixXd rows_;  ///< components × d
  std::vector<Objective> objectives_;
  Objective lightness_;
  Objective generic_;
};

}  // namespace indet
