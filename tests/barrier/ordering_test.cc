#include "libindet/barrier/ordering.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "libindet/base/random.h"

namespace indet::barrier {
namespace {

using Graph = std::vector<std::vector<int>>;

Graph random_graph(int nodes, int edges, Random& random) {
  std::vector<std::set<int>> sets(static_cast<std::size_t>(nodes));
  for (int k = 0; k < edges && nodes > 1; ++k) {
    const auto a = random.below(static_cast<std::uint64_t>(nodes));
    const auto b = random.below(static_cast<std::uint64_t>(nodes));
    if (a == b) continue;
    sets[a].insert(static_cast<int>(b));
    sets[b].insert(static_cast<int>(a));
  }
  Graph graph;
  for (const auto& set : sets) graph.emplace_back(set.begin(), set.end());
  return graph;
}

TEST(Ordering, IsAPermutationWithTheLastNodesLast) {
  Random random(11);
  for (int repeat = 0; repeat < 100; ++repeat) {
    const int nodes = static_cast<int>(random.below(30));
    Graph graph = random_graph(nodes, 2 * nodes, random);
    for (auto& list : graph) {
      if (random.uniform() < 0.5) std::reverse(list.begin(), list.end());
    }
    std::vector<bool> last;
    std::vector<int> marked;
    for (int i = 0; i < nodes; ++i) {
      last.push_back(repeat % 3 != 0 && random.uniform() < (repeat % 3 == 1 ? 0.2 : 0.9));
      if (last.back()) marked.push_back(i);
    }
    const std::vector<int> order = fill_reducing_order(graph, last);
    std::vector<int> sorted = order;
    std::sort(sorted.begin(), sorted.end());
    ASSERT_EQ(static_cast<int>(sorted.size()), nodes);
    for (int i = 0; i < nodes; ++i) EXPECT_EQ(sorted[static_cast<std::size_t>(i)], i);
    EXPECT_TRUE(
        std::equal(marked.begin(), marked.end(), order.end() - static_cast<std::ptrdiff_t>(marked.size())));
  }
}

/// How many entries elimination in this order adds below the diagonal, by definition: each node joins its
/// later neighbours to each other.
int fill_of(const Graph& graph, const std::vector<int>& order) {
  std::vector<std::set<int>> left;
  for (const auto& list : graph) left.emplace_back(list.begin(), list.end());
  int fill = 0;
  for (const int node : order) {
    const std::set<int> later = left[static_cast<std::size_t>(node)];
    for (const int a : later) {
      left[static_cast<std::size_t>(a)].erase(node);
      for (const int b : later) {
        if (a < b && left[static_cast<std::size_t>(a)].insert(b).second) {
          left[static_cast<std::size_t>(b)].insert(a);
          ++fill;
        }
      }
    }
  }
  return fill;
}

/// A star eliminated from its middle fills entirely, from its tips not at all; nor does a chain or a tree
/// need any fill.
TEST(Ordering, FillsNoTree) {
  Random random(12);
  for (int repeat = 0; repeat < 20; ++repeat) {
    Graph tree(40);
    for (int i = 1; i < 40; ++i) {
      const int parent = repeat == 0 ? 0 : static_cast<int>(random.below(static_cast<std::uint64_t>(i)));
      tree[static_cast<std::size_t>(i)].push_back(parent);
      tree[static_cast<std::size_t>(parent)].push_back(i);
    }
    EXPECT_EQ(fill_of(tree, fill_reducing_order(tree, std::vector<bool>(40, false))), 0);
  }
}

/// A square lattice of side² nodes, numbered row by row.
Graph square_lattice(int side) {
  Graph lattice(static_cast<std::size_t>(side * side));
  for (int k = 0; k < side * side; ++k) {
    std::vector<int>& list = lattice[static_cast<std::size_t>(k)];
    if (k % side != 0) list.push_back(k - 1);
    if (k % side != side - 1) list.push_back(k + 1);
    if (k >= side) list.push_back(k - side);
    if (k < side * (side - 1)) list.push_back(k + side);
  }
  return lattice;
}

TEST(Ordering, FillsALatticeLessThanRowByRow) {
  const int side = 20;
  const Graph lattice = square_lattice(side);
  std::vector<int> row_by_row(static_cast<std::size_t>(side * side));
  std::iota(row_by_row.begin(), row_by_row.end(), 0);
  const std::vector<int> order = fill_reducing_order(lattice, std::vector<bool>(side * side, false));
  EXPECT_LT(2 * fill_of(lattice, order), fill_of(lattice, row_by_row));
}

/// Multiplications of a Cholesky factorisation, the sum of the squares of the columns' entries: row i of the
/// factor has the nodes of the elimination tree between the entries of row i of the matrix and i.
double products_of(const Graph& graph, const std::vector<int>& order) {
  const std::size_t count = graph.size();
  std::vector<int> place(count), parent(count, -1), seen(count, -1);
  std::vector<double> entries(count, 1);
  for (std::size_t k = 0; k < count; ++k) place[static_cast<std::size_t>(order[k])] = static_cast<int>(k);
  for (std::size_t k = 0; k < count; ++k) {
    const int row = static_cast<int>(k);
    seen[k] = row;
    for (const int other : graph[static_cast<std::size_t>(order[k])]) {
      for (int j = place[static_cast<std::size_t>(other)];
           j < row && seen[static_cast<std::size_t>(j)] != row; j = parent[static_cast<std::size_t>(j)]) {
        seen[static_cast<std::size_t>(j)] = row;
        entries[static_cast<std::size_t>(j)] += 1;
        if (parent[static_cast<std::size_t>(j)] < 0) parent[static_cast<std::size_t>(j)] = row;
      }
    }
  }
  double products = 0;
  for (const double e : entries) products += e * e;
  return products;
}

/// A square lattice that is periodic in both directions, as the graph of a cell is: minimum degree takes 36
/// side³ products at this size, nested dissection 24 side³.
TEST(Ordering, DissectsAPeriodicLattice) {
  const int side = 60;
  ASSERT_GE(static_cast<std::size_t>(side * side), kNestedDissectionNodes + 1);
  Graph lattice = square_lattice(side);
  for (int k = 0; k < side; ++k) {
    for (const auto& [first, end] :
         {std::pair(k, k + side * (side - 1)), std::pair(k * side, k * side + side - 1)}) {
      lattice[static_cast<std::size_t>(first)].push_back(end);
      lattice[static_cast<std::size_t>(end)].push_back(first);
    }
  }
  std::vector<bool> last(lattice.size(), false);
  last[7] = true;
  const std::vector<int> order = fill_reducing_order(lattice, last);
  EXPECT_EQ(order.back(), 7);
  std::vector<int> sorted = order;
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 0; i < sorted.size(); ++i) ASSERT_EQ(sorted[i], static_cast<int>(i));
  EXPECT_LT(products_of(lattice, order), 28.0 * side * side * side);
  EXPECT_EQ(fill_reducing_order(lattice, last), order);
}

}  // namespace
}  // namespace indet::barrier
