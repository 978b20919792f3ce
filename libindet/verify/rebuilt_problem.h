#pragma once

#include <Eigen/Core>
#include <vector>

#include "libindet/packing/packing.h"

namespace indet {

/// The equilibrium problem built a second time, straight from the paper and from the packing alone, and
/// solved with other means than the analysis uses: a dense contact matrix [15] with all 2M columns (T is held
/// at 0 where μ = 0 by a row of its own) and rows of 0 for fixed disks, and its kernel by column-pivoted
/// Householder QR. Forces in units of
/// the packing's force unit.
class RebuiltProblem {
 public:
  explicit RebuiltProblem(const Packing& packing);

  int nullity() const { return static_cast<int>(kernel_.cols()); }
  const Eigen::MatrixXd& kernel() const { return kernel_; }  ///< 2M × d, orthonormal
  double force_unit() const { return force_unit_; }
  /// The unit that tolerances are meant in, in force units (Packing::internal_force_unit).
  double internal_unit() const { return internal_unit_; }

  /// Largest entry of cF + w, torques divided by the radius.
  double imbalance(const Eigen::VectorXd& forces) const;
  /// Largest entry of cF.
  double imbalance_without_load(const Eigen::VectorXd& forces) const;
  /// Slack of half-plane h: 2α: μR + T (R where μ = 0), 2α + 1: μR − T (R where μ = 0), divided by √(1 + μ²),
  /// as −min(0, ·) for all: largest violation.
  double violation(const Eigen::VectorXd& forces) const;
  double slack(int half_plane, const Eigen::VectorXd& forces) const;
  /// The inward normal of a half-plane within ker c: the slack along kernel() · z changes by its product
  /// with z.
  Eigen::VectorXd normal_of(int half_plane) const;

  /// Sliding contacts (a non-transmitting one counts twice) and non-transmitting ones, with ε = kSliding
  /// in the internal unit.
  struct SlidingCount {
    int sliding = 0, non_transmitting = 0;
  };
  SlidingCount count_sliding(const Eigen::VectorXd& forces) const;

  /// How far component e of the forces (2α: R_α, 2α + 1: T_α), times `sign`, is from being maximal at a state
  /// with these tight half-planes: the distance of its gradient from the cone of their outward normals, both
  /// within ker c (Farkas). 0 proves optimality.
  double optimality_gap(int component, double sign, const std::vector<int>& tight) const;

  /// True if the virtual motion v [N, 3] (x, y, rω) proves that the packing cannot stand: the load's power,
  /// and the smallest power of any edge of any contact cone.
  double load_power(const Eigen::MatrixXd& motion) const;
  double smallest_contact_power(const Eigen::MatrixXd& motion) const;

 private:
  const Packing& packing_;
  double force_unit_, internal_unit_;
  Eigen::MatrixXd matrix_;  ///< 3N × 2M
  Eigen::VectorXd wrench_;  ///< 3N
  Eigen::MatrixXd kernel_;  ///< 2M × d
};

}  // namespace indet
