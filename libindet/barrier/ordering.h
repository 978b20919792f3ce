#pragma once

#include <vector>

namespace indet::barrier {

/// An order of elimination with little fill of a symmetric sparse matrix, by approximate minimum degree
/// (Amestoy, Davis, Duff, ACM Trans. Math. Softw. 30, 381 (2004)): order[k] is the node that comes k-th.
/// `neighbours`: of each node the others that share an entry with it, in any order, without repetition. Nodes
/// marked `last` come last, in ascending order. Throws LibraryError when AMD fails. The only file that
/// includes AMD.
std::vector<int> fill_reducing_order(const std::vector<std::vector<int>>& neighbours,
                                     const std::vector<bool>& last);

}  // namespace indet::barrier
