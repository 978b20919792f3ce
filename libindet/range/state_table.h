#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "libindet/lp/vertex.h"
#include "libindet/polytope/force_polytope.h"
#include "libindet/range/outcome.h"

namespace indet {

/// The state with one block at a vertex and everything else at the state of smallest total normal force.
InternalForces state_at(const ForcePolytope& polytope, std::size_t block, const Vertex& vertex);

/// Collects the distinct extremal states, each with the half-planes that define it, and the directions of
/// unbounded growth.
class StateTable {
 public:
  /// `polytope` must outlive the table, and not be empty.
  explicit StateTable(const ForcePolytope& polytope) : polytope_(polytope) {}

  /// The row of state_at().
  int add(std::size_t block, const Vertex& vertex);
  /// The row of the state of smallest total normal force.
  int lightest();
  /// The row of a direction x of one block.
  int add_ray(std::size_t block, const Eigen::VectorXd& x);

  /// The rows so far: ExtremalStates::states, in the scene's unit of force, `active` and `rays`.
  Rows<double> states() const;
  Eigen::Array<std::int32_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> active() const;
  Rows<double> rays() const;

 private:
  int count() const { return static_cast<int>(states_.size()); }
  void append(const InternalForces& state, int block, const Basis& basis);

  const ForcePolytope& polytope_;
  std::map<std::pair<int, Basis>, int> numbers_;
  std::vector<InternalForces> states_;
  std::vector<std::vector<std::int32_t>> active_;
  std::vector<Eigen::VectorXd> rays_;
};

}  // namespace indet
