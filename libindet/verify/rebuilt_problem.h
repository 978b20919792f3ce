#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "libindet/packing/force_bounds.h"
#include "libindet/packing/packing.h"

namespace indet {

/// The nullity of a sparse matrix c, with singular values below `threshold` times its largest column taken
/// for 0: the signs of LDLᵀ = ccᵀ − τ²·1 count them (Sylvester's law of inertia). None if a pivot vanishes.
std::optional<int> nullity_by_inertia(const Eigen::SparseMatrix<double>& matrix, double threshold);

/// The equilibrium problem built a second time, straight from the paper and from the packing alone, and
/// solved with other means than the analysis uses: a contact matrix [15] with all 2M columns (T is held at 0
/// where μ = 0 by a row of its own), two rows a wall (0 for what is fixed) and three for the stress of the
/// cell (xx or the pressure, yy, xy; 0 for what is not imposed), and its kernel by column-pivoted Householder
/// QR. The kernel is dense, and found when it is first needed: what needs states in the file, or samples.
/// Forces in units of the packing's force unit. Not for several threads at once.
class RebuiltProblem {
 public:
  explicit RebuiltProblem(const Packing& packing);

  int nullity() const { return static_cast<int>(kernel().cols()); }
  /// The same without the kernel.
  std::optional<int> nullity_by_inertia(double threshold) const;
  const Eigen::MatrixXd& kernel() const;  ///< 2M × d, orthonormal
  int contact_count() const { return packing_.contact_count(); }
  bool has_friction(int contact) const { return packing_[ContactId(contact)].mu > 0; }
  const Eigen::SparseMatrix<double>& matrix() const { return matrix_; }  ///< c [15]
  const Eigen::VectorXd& wrench() const { return wrench_; }              ///< w: cF = −w
  const std::vector<int>& held() const { return held_; }  ///< components of forces that are given
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
  /// The narrowest interval that bounds leave to a force, in force units; +inf: none.
  double narrowest_interval() const;
  /// Half-planes 2M, 2M + 1, … are the bounds of the scene (force_bounds.h) that are inequalities.
  int half_planes() const { return 2 * packing_.contact_count() + static_cast<int>(inequalities_.size()); }
  /// The same along a direction of growth, in which bounds have the value 0.
  double ray_violation(const Eigen::VectorXd& ray) const;
  double slack(int half_plane, const Eigen::VectorXd& forces) const;
  /// What the slack of a half-plane changes by, for each unit of R and of T of its contact.
  struct Gradient {
    int contact = 0;
    Vector2 along;
  };
  Gradient gradient_of(int half_plane) const;
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
  /// The same for the sum coefficients · (R_1, T_1, …).
  double optimality_gap(const Eigen::VectorXd& coefficients, const std::vector<int>& tight) const;

  /// A virtual motion [N, 3] (x, y, rω) of disks, of walls [W, 2] (along normal and tangent; or none) and of
  /// the cell [2, 2] (rate of compression times its length; or none) as one column. It proves that the
  /// packing cannot stand if the load's power is positive, and the smallest power of any edge of any contact
  /// cone is not negative.
  Eigen::VectorXd flat_motion(const Eigen::MatrixXd& disks, const Eigen::MatrixXd& walls,
                              const Eigen::MatrixXd& cell) const;
  double load_power(const Eigen::VectorXd& motion) const;
  double smallest_contact_power(const Eigen::VectorXd& motion) const;
  /// The same where the scene bounds forces, with a multiplier for each of force_bounds() (ForcePolytope::
  /// bound_multipliers): what bounds add to the power, and the smallest power with that of the slacks.
  double bounds_power(const Eigen::VectorXd& multipliers) const;
  double smallest_power(const Eigen::VectorXd& motion, const Eigen::VectorXd& multipliers) const;

  /// Σ factor · (one number an unknown or an equation), with the sum of the sizes of its terms.
  struct Sum {
    double value = 0, size = 0;
    void add(double term) {
      value += term;
      size += std::abs(term);
    }
  };
  /// The multipliers y of the scene's rows (Duals): those of c, then those of bounds.
  Eigen::Index scene_rows() const { return matrix_.rows() + static_cast<Eigen::Index>(bounds_.size()); }
  /// b·y.
  Sum load_product(const Eigen::VectorXd& y) const;
  /// Visits (contact, R, T, Aᵀ y) for each edge (R, T) = (1, ±μ) of the contacts' cones, (1, 0) where μ = 0,
  /// and then for the slack of each bound that is an inequality, with R = T = 0.
  void for_each_edge(
      const Eigen::VectorXd& y,
      const std::function<void(int contact, double R, double T, const Sum& along)>& visit) const;

 private:
  void add_stress(std::vector<Eigen::Triplet<double>>& entries);
  /// A row for each force that is held, and c: (held + 3N + 2W + 3) × 2M.
  Eigen::SparseMatrix<double> constraints() const;

  const Packing& packing_;
  double force_unit_, internal_unit_;
  Eigen::SparseMatrix<double> matrix_;  ///< (3N + 2W + 3) × 2M
  Eigen::VectorXd wrench_;              ///< 3N + 2W + 3
  std::vector<int> held_;
  mutable std::optional<Eigen::MatrixXd> kernel_;
  std::vector<ForceBound> bounds_, inequalities_, equalities_;
};

}  // namespace indet
