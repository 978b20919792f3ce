#include "libindet/polytope/blocks.h"

#include <algorithm>
#include <map>
#include <memory>

#include "libindet/base/disjoint_sets.h"
#include "libindet/base/tolerances.h"
#include "libindet/dense/qr.h"
#include "libindet/lp/independent_equations.h"
#include "libindet/nullspace/sparse_qr.h"

namespace indet {
namespace {

/// Columns of the edge matrix of one block, with as many independent rows as it has.
void describe_sparsely(const EquilibriumProblem& problem, PolytopeBlock& block) {
  Eigen::SparseMatrix<double> columns(problem.equations(), static_cast<Eigen::Index>(block.edges.size()));
  std::vector<Eigen::Triplet<double>> triplets;
  for (std::size_t k = 0; k < block.edges.size(); ++k) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(problem.edge_matrix, block.edges[k]); it; ++it) {
      triplets.emplace_back(static_cast<int>(it.row()), static_cast<int>(k), it.value());
    }
  }
  columns.setFromTriplets(triplets.begin(), triplets.end());
  const std::vector<int> rows = SparseQr(columns.transpose(), tolerance::kRankReject).independent_columns();
  block.view.set =
      std::make_shared<const FeasibleSet>(independent_equations(columns, rows, block.view.offset));
}

}  // namespace

std::vector<PolytopeBlock> split_into_blocks(const EquilibriumProblem& problem, const SlopeView& whole,
                                             const Vertex& vertex) {
  const int d = whole.dim();
  const int count = whole.inequalities();
  const Eigen::MatrixXd D = whole.slope * vertex.active.inverse();
  const double zero = tolerance::kCoupling;

  // Elements 0 … d − 1: coordinates; then one element an edge.
  DisjointSets sets(d + count);
  std::vector<bool> moves(static_cast<std::size_t>(count), false);
  for (int j = 0; j < d; ++j) {
    for (int k = 0; k < count; ++k) {
      if (std::abs(D(k, j)) <= zero) continue;
      sets.join(d + k, j);
      moves[static_cast<std::size_t>(k)] = true;
    }
  }
  for (int k = 1; k < count; ++k) {
    const auto i = static_cast<std::size_t>(k);
    if (problem.edges[i].contact == problem.edges[i - 1].contact && moves[i] && moves[i - 1])
      sets.join(d + k, d + k - 1);
  }

  std::map<std::size_t, PolytopeBlock> by_root;
  std::map<std::size_t, std::vector<int>> coordinates;
  for (int k = 0; k < count; ++k) {
    if (moves[static_cast<std::size_t>(k)]) by_root[sets.root(d + k)].edges.push_back(k);
  }
  for (int j = 0; j < d; ++j) coordinates[sets.root(j)].push_back(j);

  std::vector<PolytopeBlock> blocks;
  for (auto& [root, block] : by_root) {
    const std::vector<int>& columns = coordinates[root];
    if (static_cast<int>(columns.size()) == d) {
      block.view.slope = whole.slope(block.edges, Eigen::all);
    } else {
      const Eigen::MatrixXd part = D(block.edges, columns);
      block.view.slope = factorise_qr(part).Q;
    }
    block.view.offset = whole.offset(block.edges);
    if (static_cast<int>(columns.size()) != d) {
      // Any point of the block serves as origin; the lightest vertex is one.
      block.view.offset = vertex.x(block.edges);
    }
    for (const int j : columns) {
      const int active = vertex.basis[static_cast<std::size_t>(j)];
      const auto local = std::lower_bound(block.edges.begin(), block.edges.end(), active);
      block.lightest.push_back(static_cast<int>(local - block.edges.begin()));
    }
    std::sort(block.lightest.begin(), block.lightest.end());
    describe_sparsely(problem, block);
    blocks.push_back(std::move(block));
  }
  std::sort(blocks.begin(), blocks.end(),
            [](const PolytopeBlock& a, const PolytopeBlock& b) { return a.edges.front() < b.edges.front(); });
  return blocks;
}

}  // namespace indet
