#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <array>
#include <cstdint>
#include <vector>

#include "libindet/packing/packing.h"

namespace indet::sim {

/// What the force of a contact may do: both components free; T = +μR or T = −μR; or R = T = 0.
enum class ContactStatus : std::uint8_t { kSticking, kSlidingUp, kSlidingDown, kOpen };

/// The least change of contact forces that balances all disks,
///
///     minimise ‖x‖²  subject to  A x = −(cF + w),
///
/// with A's columns the unit force directions that the contacts' statuses leave free, through the normal
/// equations A Aᵀ (3N × 3N, sparse Cholesky with refinement). Forces are in the internal unit of the packing,
/// torques are divided by the disk's radius. Fixed disks have rows of 0.
///
/// Which entries of A Aᵀ can differ from zero follows from the contacts alone: the order of elimination and
/// the pattern of the factor are found once, and each set of statuses only fills in numbers. Results depend
/// on the arguments of the last `factorise` and of `apply` alone, not on what was solved before.
class BalanceSolver {
 public:
  explicit BalanceSolver(const Packing& packing);

  /// Factorises A Aᵀ for one status a contact. False if that fails.
  bool factorise(const std::vector<ContactStatus>& statuses);

  /// Changes F = (R_1, T_1, …) by x. Precondition: the last `factorise` returned true.
  void apply(Eigen::VectorXd& forces);

  /// ‖x‖ of the least change, or a little less where the contacts cannot balance the disks. Precondition as
  /// that of `apply`.
  double least_change(const Eigen::VectorXd& forces);

  /// Largest component of cF + w.
  double residual(const Eigen::VectorXd& forces);

 private:
  /// The wrench that a unit force along one direction (R, T) of a contact has on its bodies: force x, y and
  /// torque/r on a; (−x, −y, torque/r) on b.
  struct Direction {
    double R, T;
    double x, y;
    double turn_a, turn_b;  ///< l/r T
  };
  struct Link {
    int row_a = -1;  ///< First of the three rows of body a, in the order of elimination. −1: fixed.
    int row_b = -1;  ///< −1: a wall, or fixed.
    double nx = 0, ny = 0;
    double arm_a = 1, arm_b = 1;  ///< l/r
    double mu = 0;
    std::array<int, 3> columns{};  ///< Places in the values of the block of a and b, one a column.
    int free = 0;                  ///< How many of the directions the status leaves.
    std::array<Direction, 2> directions{};

    Direction direction(double R, double T) const;
    bool joins_two_rows() const { return row_a >= 0 && row_b >= 0; }
  };

  void lay_out(int disks);
  void add(const Link& link, const Direction& direction);

  std::vector<Link> links_;
  Eigen::VectorXd load_;       ///< w, in the order of elimination.
  Eigen::VectorXd imbalance_;  ///< cF + w of the last `residual`.
  Eigen::VectorXd solution_;
  std::vector<std::array<int, 3>> diagonal_;  ///< Places of the block of a body with itself, one a column.
  std::vector<ContactStatus> factorised_;     ///< What the factor is of.
  bool usable_ = false;
  /// The upper triangle of A Aᵀ, in the order of elimination.
  Eigen::SparseMatrix<double> normal_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Upper, Eigen::NaturalOrdering<int>> cholesky_;
};

}  // namespace indet::sim
