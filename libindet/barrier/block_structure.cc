#include "libindet/barrier/block_structure.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "libindet/barrier/ordering.h"

namespace indet::barrier {

BlockStructure::BlockStructure(const EquilibriumProblem& problem, std::span<const int> rows, Limit limit)
    : limit_(std::move(limit)), columns_(problem.unknowns()) {
  collect_nodes(problem, rows);
  collect_groups(problem);
  if (has_limit()) add_limit();
  order_nodes();
  list_products();
}

void BlockStructure::collect_nodes(const EquilibriumProblem& problem, std::span<const int> rows) {
  // Rows of bodies by their body, of bounds by their contact.
  std::map<std::pair<int, int>, std::vector<int>> nodes;
  for (const int row : rows) {
    const EquilibriumRow& equation = problem.rows[static_cast<std::size_t>(row)];
    const bool is_bound = equation.bound >= 0;
    const int name = is_bound ? problem.bounds[static_cast<std::size_t>(equation.bound)].bound.contact.value()
                              : equation.body.code();
    nodes[{is_bound ? 1 : 0, name}].push_back(row);
  }
  place_of_equation_.assign(static_cast<std::size_t>(problem.equations()), -1);
  first_row_ = {0};
  for (const auto& [name, equations] : nodes) {
    const EquilibriumRow& first = problem.rows[static_cast<std::size_t>(equations.front())];
    is_last_.push_back(first.bound < 0 && (first.body.is_wall() || first.body.is_cell()));
    for (const int row : equations) {
      place_of_equation_[static_cast<std::size_t>(row)] = static_cast<int>(equation_of_place_.size());
      equation_of_place_.push_back(row);
      load_.push_back(problem.load()[row]);
    }
    first_row_.push_back(static_cast<int>(equation_of_place_.size()));
  }
}

void BlockStructure::collect_groups(const EquilibriumProblem& problem) {
  std::vector<int> node_of_place;
  for (int node = 0; node < nodes(); ++node)
    node_of_place.insert(node_of_place.end(), static_cast<std::size_t>(node_rows(node)), node);
  for (int column = 0; column < columns_;) {
    const Edge& edge = problem.edge(column);
    const int count = problem.is_stick(edge) ? 2 : 1;
    // The entries of these columns, by node.
    std::map<int, std::vector<std::pair<int, double>>> blocks;  // place in the block, value
    for (int k = 0; k < count; ++k) {
      for (Eigen::SparseMatrix<double>::InnerIterator it(problem.edge_matrix, column + k); it; ++it) {
        const int place = place_of_equation_[static_cast<std::size_t>(it.row())];
        if (place < 0) continue;
        const int node = node_of_place[static_cast<std::size_t>(place)];
        blocks[node].emplace_back(k * node_rows(node) + place - first_row(node), it.value());
      }
    }
    Group group{column, count, static_cast<int>(touches_.size()), 0};
    for (const auto& [node, entries] : blocks) {
      touches_.push_back({node, node_rows(node), first_row(node), static_cast<int>(coefficients_.size())});
      const auto size = static_cast<std::size_t>(count * node_rows(node));
      coefficients_.resize(coefficients_.size() + size, 0.0);
      for (const auto& [place, value] : entries)
        coefficients_[static_cast<std::size_t>(touches_.back().coefficients + place)] += value;
    }
    group.end_touch = static_cast<int>(touches_.size());
    groups_.push_back(group);
    column += count;
  }
}

/// A node of one row, a touch more of each group with a column in it, and the group of the slack.
void BlockStructure::add_limit() {
  const int node = nodes();
  const int place = rows();
  is_last_.push_back(true);
  equation_of_place_.push_back(-1);
  load_.push_back(limit_.total);
  first_row_.push_back(place + 1);
  groups_.push_back({columns_, 1, static_cast<int>(touches_.size()), static_cast<int>(touches_.size())});
  std::vector<double> entry(static_cast<std::size_t>(columns_) + 1, 0.0);
  for (const int column : limit_.columns) entry[static_cast<std::size_t>(column)] = 1;
  entry.back() = 1;
  ++columns_;
  std::vector<Touch> touches;
  for (Group& group : groups_) {
    const int first = static_cast<int>(touches.size());
    for (int t = group.first_touch; t < group.end_touch; ++t)
      touches.push_back(touches_[static_cast<std::size_t>(t)]);
    const auto begin = entry.begin() + group.first_column;
    if (std::any_of(begin, begin + group.columns, [](double value) { return value != 0; })) {
      touches.push_back({node, 1, place, static_cast<int>(coefficients_.size())});
      coefficients_.insert(coefficients_.end(), begin, begin + group.columns);
    }
    group.first_touch = first;
    group.end_touch = static_cast<int>(touches.size());
  }
  touches_ = std::move(touches);
}

void BlockStructure::order_nodes() {
  const auto count = static_cast<std::size_t>(nodes());
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
  const std::vector<int> order = fill_reducing_order(neighbours, is_last_);

  std::vector<int> number(count);
  for (std::size_t k = 0; k < count; ++k) number[static_cast<std::size_t>(order[k])] = static_cast<int>(k);
  std::vector<int> first_row{0}, equations;
  std::vector<double> load;
  for (const int old : order) {
    for (int place = first_row_[static_cast<std::size_t>(old)];
         place < first_row_[static_cast<std::size_t>(old) + 1]; ++place) {
      const int row = equation_of_place_[static_cast<std::size_t>(place)];
      const int new_place = static_cast<int>(equations.size());
      (row >= 0 ? place_of_equation_[static_cast<std::size_t>(row)] : limit_place_) = new_place;
      equations.push_back(row);
      load.push_back(load_[static_cast<std::size_t>(place)]);
    }
    first_row.push_back(static_cast<int>(equations.size()));
  }
  first_row_ = std::move(first_row);
  equation_of_place_ = std::move(equations);
  load_ = std::move(load);
  for (Touch& touch : touches_) {
    touch.node = number[static_cast<std::size_t>(touch.node)];
    touch.first_row = first_row_[static_cast<std::size_t>(touch.node)];
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
