#include "libindet/barrier/block_structure.h"

#include <algorithm>

#include "libindet/barrier/ordering.h"

namespace indet::barrier {

BlockStructure::BlockStructure(const EquilibriumProblem& problem, std::span<const int> rows, Limit limit)
    : BlockStructure(block_system(problem, rows, std::move(limit))) {}

BlockStructure::BlockStructure(const BlockSystem& system) : limit_(system.limit) {
  collect_groups(system);
  order_nodes(system);
  list_products();
}

void BlockStructure::collect_groups(const BlockSystem& system) {
  for (const BlockSystem::Group& source : system.groups) {
    Group group{columns_, source.columns, static_cast<int>(touches_.size()), 0};
    for (const BlockSystem::Part& part : source.parts) {
      const auto rows = static_cast<int>(system.nodes[static_cast<std::size_t>(part.node)].equations.size());
      touches_.push_back({part.node, rows, 0, static_cast<int>(coefficients_.size())});
      coefficients_.insert(coefficients_.end(), part.coefficients.begin(), part.coefficients.end());
    }
    group.end_touch = static_cast<int>(touches_.size());
    groups_.push_back(group);
    columns_ += source.columns;
  }
}

void BlockStructure::order_nodes(const BlockSystem& system) {
  const std::size_t count = system.nodes.size();
  std::vector<std::vector<int>> neighbours(count);
  for (const Group& group : groups_) {
    for (int u = group.first_touch; u < group.end_touch; ++u) {
      for (int v = group.first_touch; v < group.end_touch; ++v) {
        const int a = touches_[static_cast<std::size_t>(u)].node;
        if (u != v)
          neighbours[static_cast<std::size_t>(a)].push_back(touches_[static_cast<std::size_t>(v)].node);
      }
    }
  }
  for (std::vector<int>& list : neighbours) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  std::vector<bool> is_last;
  for (const BlockSystem::Node& node : system.nodes) is_last.push_back(node.is_last);
  const std::vector<int> order = fill_reducing_order(neighbours, is_last);

  std::vector<int> number(count);
  for (std::size_t k = 0; k < count; ++k) number[static_cast<std::size_t>(order[k])] = static_cast<int>(k);
  place_of_equation_.assign(system.load.size(), -1);
  first_row_ = {0};
  for (const int old : order) {
    const BlockSystem::Node& node = system.nodes[static_cast<std::size_t>(old)];
    for (const int equation : node.equations) {
      const auto place = static_cast<int>(equation_of_place_.size());
      place_of_equation_[static_cast<std::size_t>(equation)] = place;
      equation_of_place_.push_back(equation);
      load_.push_back(system.load[static_cast<std::size_t>(equation)]);
      if (node.is_elastic) elastic_rows_.push_back(place);
    }
    is_elastic_.push_back(node.is_elastic);
    first_row_.push_back(static_cast<int>(equation_of_place_.size()));
  }
  if (has_limit()) {
    // Not an equation of the problem.
    limit_place_ = place_of_equation_.back();
    place_of_equation_.pop_back();
    equation_of_place_[static_cast<std::size_t>(limit_place_)] = -1;
  }
  for (Touch& touch : touches_) {
    touch.node = number[static_cast<std::size_t>(touch.node)];
    touch.first_row = first_row(touch.node);
  }
  std::vector<std::vector<int>> renumbered(count);
  for (std::size_t k = 0; k < count; ++k) {
    for (const int other : neighbours[static_cast<std::size_t>(order[k])])
      renumbered[k].push_back(number[static_cast<std::size_t>(other)]);
  }
  find_fill(renumbered);
}

/// The blocks of the factor: those of the matrix and of the columns whose first block below the diagonal is
/// in this row.
void BlockStructure::find_fill(const std::vector<std::vector<int>>& neighbours) {
  const auto count = static_cast<std::size_t>(nodes());
  std::vector<std::vector<int>> pattern(count), children(count);
  std::vector<int> mark(count, -1);
  row_length_.assign(count, 0);
  first_block_ = {0};
  block_value_ = {0};
  for (std::size_t j = 0; j < count; ++j) {
    const int node = static_cast<int>(j);
    std::vector<int>& below = pattern[j];
    const auto add = [&](int i) {
      if (i <= node || mark[static_cast<std::size_t>(i)] == node) return;
      mark[static_cast<std::size_t>(i)] = node;
      below.push_back(i);
    };
    for (const int i : neighbours[j]) add(i);
    for (const int child : children[j]) {
      for (const int i : pattern[static_cast<std::size_t>(child)]) add(i);
      pattern[static_cast<std::size_t>(child)] = {};
    }
    std::sort(below.begin(), below.end());
    if (!below.empty()) children[static_cast<std::size_t>(below.front())].push_back(node);
    const auto add_block = [&](int i) {
      block_node_.push_back(i);
      row_length_[static_cast<std::size_t>(i)] += node_rows(node);
      block_value_.push_back(block_value_.back() + node_rows(i) * node_rows(node));
    };
    add_block(node);
    for (const int i : below) add_block(i);
    first_block_.push_back(static_cast<int>(block_node_.size()));
  }
}

int BlockStructure::block_of(int row_node, int column_node) const {
  if (row_node == column_node) return first_block(column_node);
  const auto begin = block_node_.begin() + first_block(column_node) + 1;
  const auto end = block_node_.begin() + first_block(column_node + 1);
  return static_cast<int>(std::lower_bound(begin, end, row_node) - block_node_.begin());
}

void BlockStructure::list_products() {
  std::vector<std::vector<Product>> by_column(static_cast<std::size_t>(nodes()));
  for (const Group& group : groups_) {
    for (int u = group.first_touch; u < group.end_touch; ++u) {
      for (int v = group.first_touch; v < group.end_touch; ++v) {
        const int row = touches_[static_cast<std::size_t>(u)].node;
        const int column = touches_[static_cast<std::size_t>(v)].node;
        if (row < column) continue;
        by_column[static_cast<std::size_t>(column)].push_back(
            {group.first_column, group.columns, u, v, block_value(block_of(row, column))});
      }
    }
  }
  first_product_ = {0};
  for (const std::vector<Product>& list : by_column) {
    products_.insert(products_.end(), list.begin(), list.end());
    first_product_.push_back(static_cast<int>(products_.size()));
  }
}

}  // namespace indet::barrier
