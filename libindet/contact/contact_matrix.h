#pragma once

#include <Eigen/SparseCore>
#include <cstdint>
#include <span>
#include <vector>

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

/// A row of the contact matrix: one equilibrium equation of one disk.
struct EquilibriumRow {
  DiskId disk;
  int component = 0;  ///< 0: force x, 1: force y, 2: torque divided by the radius.
};

/// An unknown: the strength x ≥ 0 of one edge of one contact's cone.
/// With κ = 1/max(1, μ), so that neither component of an edge exceeds 1:
///   R = κ Σ x,  T = κ μ Σ ± x,  and for kStick  μR + T = 2κμ x₊,  μR − T = 2κμ x₋.
struct Edge {
  ContactId contact;
  int sign = 0;  ///< +1: T = +μR, −1: T = −μR, 0: frictionless.
  double R = 0;  ///< R of the edge for x = 1: κ.
  double T = 0;  ///< T of the edge for x = 1: ±κμ.
};

/// The equilibrium problem of a packing in dimensionless form, with the unknowns and equations that the scene
/// needs.
///
/// Paper: cF = −w [5, 15]. Here forces are in units of `force_unit` (Packing::internal_force_unit), and
/// torque rows are divided by the disk's radius; the coefficients are then n̂, t̂ and 1, whatever the scale of
/// the scene. A disk whose contacts are all frictionless has no torque row (unless a torque acts on it); a
/// disk with neither contact nor load has no row.
///
///   columns: for each contact R, T (kStick), the strength along its edge (kSlide…, kFrictionless), or
///   nothing (kOpen) matrix · u = −wrench,   F = expand(u),   F = (R_1, T_1, …, R_M, T_M) in force units
struct ContactMatrix {
  Eigen::SparseMatrix<double> matrix;  ///< equations × unknowns
  Eigen::VectorXd wrench;              ///< equations; dimensionless
  std::vector<EquilibriumRow> rows;    ///< what each equation is
  std::vector<ContactMode> modes;      ///< M
  Eigen::SparseMatrix<double> forces;  ///< 2M × unknowns: F = forces · u
  std::vector<Edge> edges;             ///< unknowns (there are as many edges as unknowns)
  Eigen::SparseMatrix<double>
      to_edges;  ///< unknowns × unknowns: x = to_edges · u, block diagonal; F ∈ K ⇔ x ≥ 0
  Eigen::SparseMatrix<double> edge_matrix;  ///< equations × unknowns: edge_matrix · x = −wrench
  Eigen::SparseMatrix<double> edge_forces;  ///< 2M × unknowns: F = edge_forces · x
  double force_unit = 1;

  int unknowns() const { return static_cast<int>(matrix.cols()); }
  int equations() const { return static_cast<int>(matrix.rows()); }
};

/// Builds the problem. Preconditions: find_defect(packing) is empty; modes.size() = M.
ContactMatrix build_contact_matrix(const Packing& packing, std::span<const ContactMode> modes);

/// The residual of equilibrium of each disk, computed contact by contact from the packing (not from a
/// matrix): force x, force y, torque/r in force units, [N, 3]. `forces` is F, 2M, in the scene's own units.
Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> equilibrium_residual(
    const Packing& packing, const Eigen::Ref<const Eigen::VectorXd>& forces);

/// How a contact state stands to the Coulomb conditions [16], with tolerance ε (force units).
struct CoulombCount {
  int sliding = 0;             ///< μR − |T| < ε, counting a non-transmitting contact twice (Sec. II E)
  int non_transmitting = 0;    ///< R, |T| < ε
  int violated = 0;            ///< R < −ε or |T| > μR + ε
  double worst_violation = 0;  ///< largest of −R and |T| − μR, force units; 0 if none
};
CoulombCount count_coulomb(const Packing& packing, const Eigen::Ref<const Eigen::VectorXd>& forces,
                           double epsilon);

}  // namespace indet
