#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <cstdint>
#include <span>
#include <vector>

#include "libindet/equilibrium/bound_rows.h"
#include "libindet/packing/loads.h"
#include "libindet/packing/packing.h"

namespace indet {

/// How a contact may transmit force: which edges of its cone K_α = {R ≥ 0, |T| ≤ μR} are open.
///
///        T            both edges      kStick        two unknowns
///        |  / T = +μR edge T = +μR    kSlidePlus    one unknown, T = +μR
///        | /          edge T = −μR    kSlideMinus   one unknown, T = −μR
///        |/___ R      μ = 0           kFrictionless one unknown, T = 0
///        |\           none            kOpen         no unknown, R = T = 0
///        | \ T = −μR
enum class ContactMode : std::uint8_t { kStick, kSlidePlus, kSlideMinus, kFrictionless, kOpen };

/// kStick where μ > 0, kFrictionless where μ = 0: what the scene allows.
std::vector<ContactMode> natural_modes(const Packing& packing);

/// What one equation balances, or which bound it poses.
struct EquilibriumRow {
  Body body;
  int component = 0;  ///< disk: 0 force x, 1 force y, 2 torque divided by the radius; wall: 0 n̂, 1 t̂; cell:
                      ///< 0 xx, 1 yy, 2 xy, 3 pressure of the stress times its area, divided by cell_length
  double unit = 1;  ///< of the equation as it would read in the scene's units: the internal unit of force,
                    ///< times the radius for a torque, times the cell's length for a stress
  double load = 0;  ///< Σ |parts of the load|, in the scene's units: it bounds the rounding of b
  int bound = -1;   ///< ≥ 0: no equation of a body but this one of the problem's bounds
};

/// An unknown: the strength x ≥ 0 of one edge of one contact's cone, or the slack of a bound.
/// With κ = 1/max(1, μ), so that neither component of an edge exceeds 1:
///   R = κ Σ x,  T = κ μ Σ ± x,  and for kStick  μR + T = 2κμ x₊,  μR − T = 2κμ x₋.
struct Edge {
  ContactId contact;
  int sign = 0;    ///< +1: T = +μR, −1: T = −μR, 0: frictionless.
  double R = 0;    ///< R of the edge for x = 1: κ.
  double T = 0;    ///< T of the edge for x = 1: ±κμ.
  int bound = -1;  ///< ≥ 0: no edge of a cone but the slack of this bound; sign, R and T are 0

  bool is_slack() const { return bound >= 0; }
};

/// The two ends of a contact in the equations. One that is open (kOpen) has none there.
struct ContactEnds {
  Vector2 normal{0, 0};  ///< n̂
  double mu = 0;
  int a = -1, b = -1;  ///< the equation of force x of each disk; force y is the next. −1: it has none.
  double arm_a = 1, arm_b = 1;  ///< l/r of each body: what T adds to its torque equation
  Vector2 branch{0, 0};         ///< l over the cell's length, where stress is imposed

  /// t̂ = n̂ × ẑ [10].
  Vector2 tangent() const { return {normal.y(), -normal.x()}; }
};

/// The equilibrium problem of a packing: everything that later stages need of it, in the internal unit of
/// force, or in a finer one where bounds of forces are narrow (problem_units, bound_rows.h).
///
///     find F with   A F = b,   F in K
///
/// Paper: cF = −w [5, 15]. Torque equations are divided by the disk's radius; the coefficients are then n̂, t̂
/// and l/r, whatever the scale of the scene: 1, unless the contact has another lever arm l. A disk whose
/// contacts are all frictionless has no torque equation (unless a torque acts on it); a fixed disk, and one
/// with neither contact nor load, has none. A loaded wall has −ΣR = −load_n, −ΣT = −load_t, what of it is
/// given: as body b of its contacts it takes their forces with the minus sign, as a disk does. Imposed stress
/// has −Σ f_i l_j / L = −A σ_ij / L of the components that are given, with L = Packing::cell_length, so that
/// the rows are forces across a side of the cell and about as long as the others. Rows of bounds come last.
///
/// Columns: for each contact R, T (kStick), the strength along its edge (kSlide…, kFrictionless), or nothing
/// (kOpen); then the slacks s of bounds:   matrix · u = b,   F = expand(u) = (R_1, T_1, …, R_M, T_M).
struct EquilibriumProblem {
  Eigen::SparseMatrix<double> matrix;  ///< A: equations × unknowns
  /// Equations × (1 + changes): b of what acts, then b_1, … of changes of it, A F = b + Σ λ_k b_k.
  Eigen::MatrixXd right_hand_sides;
  std::vector<EquilibriumRow> rows;         ///< what each equation is
  std::vector<ContactMode> modes;           ///< M
  std::vector<ContactEnds> contacts;        ///< M
  std::vector<BoundRow> bounds;             ///< of force_bounds(packing), in its order
  std::vector<Edge> edges;                  ///< unknowns (there are as many edges as unknowns)
  Eigen::SparseMatrix<double> to_edges;     ///< unknowns × unknowns, block diagonal: x = to_edges · u;
                                            ///< F ∈ K ⇔ x ≥ 0
  Eigen::SparseMatrix<double> edge_matrix;  ///< A on edges: equations × unknowns, edge_matrix · x = b
  Eigen::SparseMatrix<double> edge_forces;  ///< 2M × unknowns: F = edge_forces · x
  ForceUnits units;                         ///< from the internal unit to others
  int disks = 0;                            ///< N, fixed ones too
  int walls = 0;                            ///< W

  int unknowns() const { return static_cast<int>(matrix.cols()); }
  int equations() const { return static_cast<int>(matrix.rows()); }
  /// The edge of an unknown.
  const Edge& edge(int unknown) const { return edges[static_cast<std::size_t>(unknown)]; }
  double mu(const Edge& edge) const { return contacts[static_cast<std::size_t>(edge.contact.value())].mu; }
  /// Both edges of its contact are open.
  bool is_stick(const Edge& edge) const {
    return !edge.is_slack() && modes[static_cast<std::size_t>(edge.contact.value())] == ContactMode::kStick;
  }
  /// The number of an edge's half-plane in files (force_bounds.h).
  int half_plane(const Edge& edge) const;
  /// The first unknown of each contact; −1 if it has none. M.
  std::vector<int> first_unknowns() const;
  /// The part of the cell in a motion of the equations (one velocity a row): the rate of compression e, times
  /// the cell's length. At a contact it adds −e · branch to the relative velocity of a and b.
  Eigen::Matrix2d compression_of(const Eigen::VectorXd& motion) const;
  /// b of the load that acts.
  auto load() const { return right_hand_sides.col(0); }

  /// The contact forces of edge strengths x.
  InternalForces state(const Eigen::VectorXd& x) const { return InternalForces(edge_forces * x); }
  /// The unknowns u of contact forces that keep to the modes. 2M.
  Eigen::VectorXd unknowns_of(const InternalForces& forces) const;
  /// The strengths x of contact forces. 2M.
  Eigen::VectorXd strengths_of(const InternalForces& forces) const;
};

/// Builds the problem. `changes`: of the loads; each has a right-hand side, and the equations are those that
/// any of the loads needs. Preconditions: find_defect(packing) is empty; modes.size() = M; defect_of() of
/// each change is.
EquilibriumProblem pose_equilibrium(const Packing& packing, std::span<const ContactMode> modes,
                                    std::span<const Loads> changes = {});
/// With every contact as the scene has it.
EquilibriumProblem pose_equilibrium(const Packing& packing);

/// The same problem with other modes, and some bounds closed. Edges may only be closed: no mode allows more
/// than the one it replaces.
EquilibriumProblem restrict_modes(const EquilibriumProblem& problem, std::span<const ContactMode> modes,
                                  std::span<const int> closed_bounds = {});

}  // namespace indet
