#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "libindet/lp/lp_solver.h"
#include "libindet/polytope/force_polytope.h"

namespace indet::bench {

/// What one method did for all objectives of a packing.
struct Tally {
  std::int64_t solves = 0;
  std::int64_t pivots = 0;
  std::int64_t failures = 0;   ///< objectives that the method itself calls failed
  std::vector<double> optima;  ///< in natural order: contact by contact, R_min, R_max, T_min, T_max of what
                               ///< is not determined, as maxima (force units); NaN where none was found
  std::vector<double> raw;     ///< the solver's own numbers, where it has them
};

/// The objectives of one block in natural order, maximised: −R, R, −T, T of each contact.
std::vector<Objective> natural_objectives(const ForcePolytope& polytope, const PolytopeBlock& block);

/// From which vertex GLPK starts an objective.
enum class Start {
  kLastOptimum,  ///< the optimum of the objective before, its factors kept: what flux variability analysis
                 ///< does
  kFirstVertex,  ///< the same vertex for all
  kScratch       ///< none: GLPK's own start basis and both of its phases
};

/// All objectives by GLPK, one after the other, in natural order or in one by chance.
Tally plain_glpk(const ForcePolytope& polytope, Formulation formulation, Start start, bool by_chance,
                 const LpOptions& options);

/// The same by Clp's primal simplex on the edge formulation, in natural order, each from the last optimum;
/// nothing if this was built without Clp.
std::optional<Tally> natural_order_clp(const ForcePolytope& polytope);

}  // namespace indet::bench
