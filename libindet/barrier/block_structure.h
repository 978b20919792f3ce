#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "libindet/barrier/block_system.h"
#include "libindet/equilibrium/equilibrium_problem.h"

namespace indet::barrier {

/// The sparsity of A and of the Cholesky factor of A D Aᵀ, D diagonal, for a system in blocks (BlockSystem).
/// Found once a packing; what is computed with it works on arrays of this order.
///
/// Two nodes share a block of A D Aᵀ where a group touches both: the graph of the packing. Walls, the cell
/// and a limit, which touch many disks, are eliminated last, so that they border the factor and fill nothing
/// else; bounds of contacts, whose two disks share a block anyway, widen nothing.
class BlockStructure {
 public:
  /// The equations of the nodes have to be independent, but for elastic ones, for A D Aᵀ to be definite. The
  /// others play no part in anything that is computed here: that they follow from these, with their loads, is
  /// for the caller to know. (A disk on an incline has a centre without its third equation, and is empty.)
  explicit BlockStructure(const BlockSystem& system);
  /// Of block_system(problem, rows, limit).
  BlockStructure(const EquilibriumProblem& problem, std::span<const int> rows, Limit limit = {});

  /// A node that a group touches: A has the block of its `rows` and the group's columns there, column by
  /// column from `coefficients`.
  struct Touch {
    int node = 0;
    int rows = 0;
    int first_row = 0;     ///< place in vectors of rows
    int coefficients = 0;  ///< into coefficients()
  };
  struct Group {
    int first_column = 0;
    int columns = 0;
    int first_touch = 0, end_touch = 0;
  };
  /// A product of two touches of one group, added to a block of A D Aᵀ.
  struct Product {
    int first_column = 0;
    int columns = 0;
    int row_touch = 0, column_touch = 0;
    std::int64_t block = 0;  ///< place of the block's first value
  };

  int columns() const { return columns_; }
  int rows() const { return first_row_.empty() ? 0 : first_row_.back(); }
  int nodes() const { return static_cast<int>(first_row_.size()) - 1; }
  /// Nodes are numbered by elimination. Places of the rows of node j: first_row(j) … first_row(j + 1) − 1.
  int first_row(int node) const { return first_row_[static_cast<std::size_t>(node)]; }
  int node_rows(int node) const { return first_row(node + 1) - first_row(node); }
  const Limit& limit() const { return limit_; }
  bool has_limit() const { return !limit_.columns.empty(); }
  /// The place of the limit's row; −1 if there is none.
  int limit_place() const { return limit_place_; }
  /// Whether the rows of a node are elastic, and the places of all rows that are.
  bool is_elastic(int node) const { return is_elastic_[static_cast<std::size_t>(node)]; }
  const std::vector<int>& elastic_rows() const { return elastic_rows_; }
  /// The equation of the system at a place (−1: the limit), and the place of an equation, −1 if it was left
  /// out.
  const std::vector<int>& equation_of_place() const { return equation_of_place_; }
  const std::vector<int>& place_of_equation() const { return place_of_equation_; }
  /// b, by places.
  const std::vector<double>& load() const { return load_; }
  /// The same with another b.
  BlockStructure with_load(std::vector<double> load) const {
    BlockStructure other = *this;
    other.load_ = std::move(load);
    return other;
  }

  const std::vector<Group>& groups() const { return groups_; }
  const std::vector<Touch>& touches() const { return touches_; }
  const std::vector<double>& coefficients() const { return coefficients_; }

  /// The blocks of column j of the factor: first_block(j) … first_block(j + 1) − 1, the diagonal one first,
  /// then ascending. Each belongs to a node (its rows) and has rows × node_rows(j) values from
  /// block_value(k), row by row.
  int first_block(int node) const { return first_block_[static_cast<std::size_t>(node)]; }
  int block_node(int block) const { return block_node_[static_cast<std::size_t>(block)]; }
  std::int64_t block_value(int block) const { return block_value_[static_cast<std::size_t>(block)]; }
  std::int64_t values() const { return block_value_.back(); }
  /// What enters the blocks of column j.
  std::span<const Product> products(int node) const {
    const auto first = static_cast<std::size_t>(first_product_[static_cast<std::size_t>(node)]);
    const auto end = static_cast<std::size_t>(first_product_[static_cast<std::size_t>(node) + 1]);
    return std::span(products_).subspan(first, end - first);
  }
  /// How many values a row of the factor has, of the rows of a node.
  int row_length(int node) const { return row_length_[static_cast<std::size_t>(node)]; }

 private:
  void collect_groups(const BlockSystem& system);
  void order_nodes(const BlockSystem& system);
  void find_fill(const std::vector<std::vector<int>>& neighbours);
  void list_products();
  int block_of(int row_node, int column_node) const;

  Limit limit_;
  int limit_place_ = -1;
  int columns_ = 0;
  std::vector<int> first_row_, equation_of_place_, place_of_equation_;
  std::vector<bool> is_elastic_;
  std::vector<int> elastic_rows_;
  std::vector<double> load_;
  std::vector<Group> groups_;
  std::vector<Touch> touches_;
  std::vector<double> coefficients_;
  std::vector<int> first_block_, block_node_;
  std::vector<std::int64_t> block_value_;
  std::vector<int> first_product_;
  std::vector<Product> products_;
  std::vector<int> row_length_;
};

}  // namespace indet::barrier
