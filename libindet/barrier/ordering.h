#pragma once

#include <vector>

namespace indet::barrier {

/// From how many nodes on nested dissection is tried beside approximate minimum degree, which takes some
/// milliseconds. In a box it loses up to 10 000 disks; in a periodic cell of 1300 it has a fifth fewer
/// products of the factorisation, and of 100 000 more than a third.
inline constexpr std::size_t kNestedDissectionNodes = 1000;

/// An order of elimination with little fill of a symmetric sparse matrix: order[k] is the node that comes
/// k-th. By approximate minimum degree (Amestoy, Davis, Duff, ACM Trans. Math. Softw. 30, 381 (2004)); from
/// kNestedDissectionNodes on by that or by CHOLMOD's nested dissection, whichever takes fewer products.
/// `neighbours`: of each node the others that share an entry with it, in any order, without repetition. Nodes
/// marked `last` come last, in ascending order. Throws LibraryError when a library fails. The only file that
/// includes AMD.
std::vector<int> fill_reducing_order(const std::vector<std::vector<int>>& neighbours,
                                     const std::vector<bool>& last);

}  // namespace indet::barrier
