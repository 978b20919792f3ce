#pragma once

#include <cstdint>

#include "libindet/pivoting/tableau.h"

namespace indet {

/// Which of the improving edges of the polytope at a vertex is followed (docs/decisions/pivot-rule.md).
enum class PivotRule : std::uint8_t {
  kDantzig,       ///< the largest gain per unit of the slack that is left
  kSteepestEdge,  ///< the largest gain per unit of length in x
  kBestNeighbour  ///< the largest gain in all, as in Sec. II G of the paper: every neighbour is looked at
};
const char* to_string(PivotRule rule);

/// The column of the polytope's edge to follow, or −1 if none gains more than `tolerance` per unit of slack.
/// `gradient`: of the objective along the edges. `is_held`: columns that may not be left.
int choose_column(const Tableau& tableau, const Eigen::VectorXd& gradient, const std::vector<char>& is_held,
                  PivotRule rule, double tolerance);

/// Bland's rule: the improving column whose inequality has the smallest number. With the stop of smallest
/// number among equals it cannot cycle (Bland, Math. Oper. Res. 2, 103 (1977)).
int choose_column_by_number(const Tableau& tableau, const Eigen::VectorXd& gradient,
                            const std::vector<char>& is_held, double tolerance);

/// The slack row that stops the way along a column's edge first, or −1 if nothing does. Slacks may fall below
/// 0 by `tolerance`; among the rows that then come into question the one with the largest rate is taken
/// (Harris, Math. Program. 5, 1 (1973)).
int first_stop(const Tableau& tableau, int column, double tolerance);

/// The same without that freedom; among equals the smallest number, as Bland's rule asks.
int first_stop_by_number(const Tableau& tableau, int column);

}  // namespace indet
