#pragma once

#include <cstddef>
#include <vector>

#include "libindet/barrier/block_structure.h"
#include "libindet/equilibrium/equilibrium_problem.h"

namespace indet::barrier {

/// Calls visit(column, place, entry) for every entry of A, zeros of blocks too.
template <class Visit>
void for_each_entry(const BlockStructure& s, Visit visit) {
  for (const BlockStructure::Group& group : s.groups()) {
    for (int e = 0; e < group.columns; ++e) {
      for (int t = group.first_touch; t < group.end_touch; ++t) {
        const BlockStructure::Touch& touch = s.touches()[static_cast<std::size_t>(t)];
        for (int r = 0; r < touch.rows; ++r) {
          visit(static_cast<std::size_t>(group.first_column + e),
                static_cast<std::size_t>(touch.first_row + r),
                s.coefficients()[static_cast<std::size_t>(touch.coefficients + e * touch.rows + r)]);
        }
      }
    }
  }
}

/// Bounds of how far an entry of A, and b, in memory are from those of the scene: one a row, in the
/// structure's order.
std::vector<double> entry_rounding(const EquilibriumProblem& problem, const BlockStructure& structure);
std::vector<double> load_rounding(const EquilibriumProblem& problem, const BlockStructure& structure);

}  // namespace indet::barrier
