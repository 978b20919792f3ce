#include "libindet/barrier/stored_entries.h"

#include <algorithm>

#include "libindet/base/rounding_bounds.h"

namespace indet::barrier {

std::vector<double> entry_rounding(const EquilibriumProblem& problem, const BlockStructure& structure) {
  // A disk that touches an image of itself has the torques of both ends in one entry.
  const bool has_sums = std::any_of(problem.contacts.begin(), problem.contacts.end(),
                                    [](const ContactEnds& ends) { return ends.a >= 0 && ends.a == ends.b; });
  std::vector<double> result;
  for (const int row : structure.equation_of_place()) {
    if (row < 0) {  // the limit: whole numbers
      result.push_back(0);
      continue;
    }
    // Entries are stored doubles or rounded a few times; those of stress are f·l/L with |f| ≤ √2, |l|/L ≤
    // 3/2, levers up to two radii.
    const bool is_stress = problem.rows[static_cast<std::size_t>(row)].body.is_cell();
    result.push_back((is_stress || has_sums ? 24 : 8) * kRoundoff);
  }
  return result;
}

std::vector<double> load_rounding(const EquilibriumProblem& problem, const BlockStructure& structure) {
  std::vector<double> result;
  for (const int row : structure.equation_of_place()) {
    if (row < 0) {
      result.push_back(0);
      continue;
    }
    const EquilibriumRow& equation = problem.rows[static_cast<std::size_t>(row)];
    result.push_back(6 * kRoundoff * equation.load / equation.unit + kTiny);
  }
  return result;
}

}  // namespace indet::barrier
