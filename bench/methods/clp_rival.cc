#include <ClpSimplex.hpp>
#include <CoinPackedMatrix.hpp>
#include <limits>
#include <stdexcept>

#include "bench/methods/rivals.h"

namespace indet::bench {
namespace {

void load(const FeasibleSet& set, ClpSimplex& model) {
  const Eigen::SparseMatrix<double>& matrix = set.equations;
  CoinPackedMatrix packed(true, static_cast<int>(matrix.rows()), static_cast<int>(matrix.cols()),
                          static_cast<int>(matrix.nonZeros()), matrix.valuePtr(), matrix.innerIndexPtr(),
                          matrix.outerIndexPtr(), nullptr);
  const std::vector<double> lower(static_cast<std::size_t>(matrix.cols()), 0.0);
  const std::vector<double> upper(static_cast<std::size_t>(matrix.cols()),
                                  std::numeric_limits<double>::max());
  const std::vector<double> cost(static_cast<std::size_t>(matrix.cols()), 0.0);
  model.loadProblem(packed, lower.data(), upper.data(), cost.data(), set.right_hand_side.data(),
                    set.right_hand_side.data());
  model.setLogLevel(0);
  model.setOptimizationDirection(-1);
}

}  // namespace

std::optional<Tally> natural_order_clp(const ForcePolytope& polytope) {
  Tally tally;
  for (const PolytopeBlock& block : polytope.blocks) {
    ClpSimplex model;
    load(block.set(), model);
    model.primal();  // a feasible basis; its pivots do not count, as the start of the others' does not
    for (const Objective& objective : natural_objectives(polytope, block)) {
      for (const auto& [index, coefficient] : objective.on_edges)
        model.setObjectiveCoefficient(index, coefficient);
      constexpr int kKeepWorkAreasAndFactors = 7;
      model.primal(0, kKeepWorkAreasAndFactors);
      if (!model.isProvenOptimal()) throw std::runtime_error("Clp: a solve failed");
      ++tally.solves;
      tally.pivots += model.numberIterations();
      tally.optima.push_back(model.objectiveValue());
      for (const auto& [index, coefficient] : objective.on_edges) model.setObjectiveCoefficient(index, 0);
    }
  }
  return tally;
}

}  // namespace indet::bench
