#pragma once

/// All tolerances of indet, with their meaning and unit. Forces inside the library are dimensionless, in
/// units of the packing's force unit (mg, the mean weight of a disk, unless the scene names another), and the
/// rows of the contact matrix are unit normals and tangents, so that "dimensionless" below means "in mg".
namespace indet::tolerance {

/// ε of the paper (Sec. III A): a contact slides if μR − |T| < ε mg and transmits nothing if R, |T| < ε mg.
/// Workable: 1e-12 … 1e-6; below 1e-12 rounding hides sliding contacts, above 1e-6 others are taken for
/// sliding.
inline constexpr double kSliding = 1e-9;

/// A unit normal may differ from length 1 by this much, and from the direction of the centres by this angle
/// (radian). Normals of other programs are printed with as few as six digits.
inline constexpr double kNormalLength = 1e-6;
inline constexpr double kNormalDirection = 1e-4;

/// A singular value of the dimensionless contact matrix below kRankReject · σ_max counts as zero; one between
/// kNoise and kRankAccept makes the rank ambiguous, and every result of that packing `imprecise`.
inline constexpr double kRankReject = 1e-13;
inline constexpr double kRankAccept = 1e-11;

/// Largest residual, relative to max(1, ‖F‖∞) in mg, with which a recomputed vertex counts as certified:
/// equilibrium (‖cF + w‖∞), contact conditions (negative part of μR ± T, R) and wrong-signed reduced costs.
inline constexpr double kPrimalResidual = 1e-10;
inline constexpr double kDualResidual = 1e-9;

/// A half-plane whose slack cannot exceed this (mg, relative to max(1, ‖F1‖∞)) anywhere in F holds with
/// equality everywhere (it lowers dim F); F is empty if some slack must be below minus this. Parts of a
/// packing may be this much lighter than the mean. Between this and kNoise the decision is doubtful, and
/// every result `imprecise`.
inline constexpr double kImplicitEquality = 1e-12;

/// Rounding level of dimensionless quantities of order one. A rejected singular value (relative to σ_max), an
/// implicit equality or a ray that is off by more than this is not clearly one. Rounding alone gives about
/// 1e-16 … 1e-15.
inline constexpr double kNoise = 1e-14;

/// GLPK's own feasibility and optimality tolerances. Its answer is only a proposal (a basis), from which we
/// recompute.
inline constexpr double kLpFeasibility = 1e-10;
inline constexpr double kLpOptimality = 1e-10;

/// An objective settled by a vertex: reduced costs above −kReducedCost (dimensionless) count as non-negative,
/// those below kReducedCost in magnitude as zero when the uniqueness of the extremal state is decided.
inline constexpr double kReducedCost = 1e-9;

/// Two values of one objective (mg, relative to max(1, |value|)) count as equal when it is asked whether a
/// vertex attains the optimum.
inline constexpr double kTie = 1e-10;

/// An objective is unbounded if it grows by more than this per unit of Σx along a direction of the recession
/// cone (dimensionless).
inline constexpr double kRay = 1e-9;

/// Default of --balance-tol: largest force or torque residual of an imported packing with known forces, in
/// mg.
inline constexpr double kBalance = 1e-6;

}  // namespace indet::tolerance
