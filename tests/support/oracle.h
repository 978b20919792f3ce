#pragma once

#include <Eigen/Core>
#include <vector>

#include "libindet/packing/packing.h"

namespace indet::oracle {

/// Slow answers found without any of the code under test: dense matrices written from the paper's formulas,
/// singular values, and enumeration of all vertices. For packings of few contacts.

/// c of the paper, 3N × 2M with every row and column, torque rows with the lever arm of each contact (r [15]
/// where it names none). Rows of fixed disks are 0.
Eigen::MatrixXd paper_matrix(const Packing& packing);

/// w, 3N, in force units.
Eigen::VectorXd paper_wrench(const Packing& packing);

/// Of a matrix with entries, descending.
Eigen::VectorXd singular_values(const Eigen::MatrixXd& a);

/// Dense rank, kernel and smallest solution of A x = b, by singular values (zero below 1e-11 of the largest).
struct DenseSolution {
  int rank = 0;
  Eigen::MatrixXd kernel;
  Eigen::VectorXd particular;
  double residual = 0;
};
DenseSolution solve_dense(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

/// A polyhedron {z : offset + slope z ≥ 0} by its vertices and extreme rays, one a row, each once: every
/// choice of d (d − 1) rows is tried.
struct Corners {
  Eigen::MatrixXd vertices;
  Eigen::MatrixXd rays;  ///< largest entry 1
};
Corners enumerate_corners(const Eigen::MatrixXd& slope, const Eigen::VectorXd& offset);

/// F of a packing: contact states (R_1, T_1, …) in force units.
struct States {
  int nullity = 0;           ///< of c restricted to T = 0 where μ = 0
  int dim = -1;              ///< of the hull of vertices and rays; −1: empty
  Eigen::MatrixXd vertices;  ///< a row a state
  Eigen::MatrixXd rays;
};
States enumerate_states(const Packing& packing);

/// Minimum (sign −1) or maximum (+1) of one component over the states.
struct Answer {
  double value = 0;            ///< ±inf where unbounded
  bool unique = false;         ///< one state attains it
  double smallest_weight = 0;  ///< least ΣR of the states that attain it
  Eigen::VectorXd lightest;    ///< the state of least ΣR, if there is only one; else empty
};
Answer extremum(const States& states, int component, int sign);

/// Calls visit with every ascending choice of k numbers below n.
template <class Visit>
void for_each_choice(int n, int k, Visit visit) {
  if (k > n) return;
  std::vector<int> choice(static_cast<std::size_t>(k));
  for (int i = 0; i < k; ++i) choice[static_cast<std::size_t>(i)] = i;
  for (;;) {
    visit(choice);
    int i = k - 1;
    while (i >= 0 && choice[static_cast<std::size_t>(i)] == n - k + i) --i;
    if (i < 0) return;
    ++choice[static_cast<std::size_t>(i)];
    for (int j = i + 1; j < k; ++j)
      choice[static_cast<std::size_t>(j)] = choice[static_cast<std::size_t>(j - 1)] + 1;
  }
}

}  // namespace indet::oracle
