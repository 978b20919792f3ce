#pragma once

#include <span>
#include <vector>

#include "libindet/equilibrium/equilibrium_problem.h"

namespace indet::barrier {

/// One row more, which cuts an unbounded set off: Σ x over `columns` + slack = total. Its slack is the last
/// column. No limit if there are no columns.
struct Limit {
  std::vector<int> columns;  ///< ascending
  double total = 0;
};

/// Equations A x = b taken together in blocks: what a BlockStructure is made of.
///
/// Equations are taken together in *nodes*, unknowns in *groups*, of which each has a block of A (a *part*)
/// in few nodes. Equations of an elastic node may be off, at a price: A x + e = b.
struct BlockSystem {
  struct Node {
    std::vector<int> equations;  ///< ascending
    bool is_last = false;        ///< to be eliminated last: it touches many others
    bool is_elastic = false;
  };
  struct Part {
    int node = 0;
    std::vector<double> coefficients;  ///< column by column, each with one a row of the node
  };
  /// Columns of x that follow those of the group before.
  struct Group {
    int columns = 0;
    std::vector<Part> parts;  ///< ascending by node
  };
  std::vector<Node> nodes;
  std::vector<Group> groups;
  std::vector<double> load;  ///< b, one an equation, those of no node too
  Limit limit;               ///< Where there is one its row is the last equation.
};

/// The equilibrium problem in edge strengths (EquilibriumProblem::edge_matrix). Nodes are the up to three
/// equations of a disk, those of a loaded wall, of the cell, the bounds of one contact; groups are the one or
/// two edges of a contact; a slack is a group of its own. A group touches few nodes: two disks, or a disk and
/// a wall; besides the cell and its own bounds. Walls, the cell and a limit, which touch many disks, are
/// last.
///
/// `rows`: the equations to keep, ascending.
BlockSystem block_system(const EquilibriumProblem& problem, std::span<const int> rows, Limit limit = {});

/// Two copies of it, and for each contact that can carry force an elastic node with what their contact forces
/// differ by:
///
///     A x = b,   A x' = b,   B (x − x') + e = 0,   B x = the R and T of the contacts
///
/// With n columns and m equations of the problem, x' has columns from n on and equations from m on, and (R,
/// T) of contact α are the equations 2m + 2α and 2m + 2α + 1.
BlockSystem pair_system(const EquilibriumProblem& problem, std::span<const int> rows);

}  // namespace indet::barrier
