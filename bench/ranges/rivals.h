#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "indet/lp/lp_solver.h"
#include "indet/polytope/force_polytope.h"

namespace indet::bench {

/// What one method did for all objectives of a packing.
struct Tally {
  std::int64_t solves = 0;
  std::int64_t pivots = 0;
  std::vector<double> optima;  ///< in natural order: contact by contact, R_min, R_max, T_min, T_max of what
                               ///< is not determined (force units)
};

/// The objectives of one block in natural order, maximised: −R, R, −T, T of each contact.
std::vector<Objective> natural_objectives(const ForcePolytope& polytope, const PolytopeBlock& block);

/// All objectives in natural order by GLPK, each from the last optimum and its factors: the scheme of flux
/// variability analysis.
Tally natural_order_glpk(const ForcePolytope& polytope, Formulation formulation);

/// The same by Clp's primal simplex on the edge formulation; nothing if this was built without Clp.
std::optional<Tally> natural_order_clp(const ForcePolytope& polytope);

}  // namespace indet::bench
