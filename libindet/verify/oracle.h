#pragma once

#include <Eigen/Core>
#include <vector>

#include "libindet/packing/packing.h"

namespace indet {

/// The equilibrium problem built a second time, straight from the paper, and solved with other means than the
/// analysis uses: a dense contact matrix [15] with all 2M columns (T is held at 0 where μ = 0 by a row of its
/// own), and its kernel by column-pivoted Householder QR. Forces in units of the packing's force unit.
class Oracle {
 public:
  explicit Oracle(const Packing& packing);

  int nullity() const { return static_cast<int>(kernel_.cols()); }
  double force_unit() const { return force_unit_; }

  /// Largest entry of cF + w, torques divided by the radius.
  double imbalance(const Eigen::VectorXd& forces) const;
  /// Largest entry of cF.
  double imbalance_without_load(const Eigen::VectorXd& forces) const;
  /// Slack of half-plane h: 2α: μR + T (R where μ = 0), 2α + 1: μR − T (R where μ = 0), divided by √(1 + μ²),
  /// as −min(0, ·) for all: largest violation.
  double violation(const Eigen::VectorXd& forces) const;
  double slack(int half_plane, const Eigen::VectorXd& forces) const;

  /// How far component e of the forces (2α: R_α, 2α + 1: T_α), times `sign`, is from being maximal at a state
  /// with these tight half-planes: the distance of its gradient from the cone of their outward normals, both
  /// within ker c (Farkas). 0 proves optimality.
  double optimality_gap(int component, double sign, const std::vector<int>& tight) const;

  /// True if the virtual motion v [N, 3] (x, y, rω) proves that the packing cannot stand: the load's power,
  /// and the smallest power of any edge of any contact cone.
  double load_power(const Eigen::MatrixXd& motion) const;
  double smallest_contact_power(const Eigen::MatrixXd& motion) const;

 private:
  Eigen::VectorXd normal_of(int half_plane) const;  ///< in ker c coordinates

  const Packing& packing_;
  double force_unit_;
  Eigen::MatrixXd matrix_;  ///< 3N × 2M
  Eigen::VectorXd wrench_;  ///< 3N
  Eigen::MatrixXd kernel_;  ///< 2M × d
};

}  // namespace indet
