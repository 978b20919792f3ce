#pragma once

/// All tolerances of indet, each with its one meaning, its unit and what it is relative to. "Internal unit"
/// is the packing's own unit of force (Packing::internal_force_unit), in which the library computes; the rows
/// of the contact matrix are unit normals and tangents, and x are strengths of the cones' edges, so that
/// lengths and rates without a unit are of order one. "Workable" is the range within which results are the
/// same but for what the tolerance decides; where none is given, a factor of 10 either way changes nothing.
namespace indet::tolerance {

// Contacts.

/// ε of the paper (Sec. III A): a contact slides if μR − |T| < ε and transmits nothing if R, |T| < ε, in
/// the internal unit (mg, but for scenes whose named unit of force says little about them).
/// Workable: 1e-12 … 1e-6; below 1e-12 rounding hides sliding contacts, above 1e-6 others are taken for
/// sliding.
inline constexpr double kSliding = 1e-9;

/// A contact with a Coulomb limit μR up to this (internal unit) has no mobilisation |T|/μR.
inline constexpr double kCoulombLimit = 1e-9;

/// A unit normal may differ from length 1 by this much, and from the direction of the centres by this angle
/// (radian). Normals of other programs are printed with as few as six digits.
inline constexpr double kNormalLength = 1e-6;
inline constexpr double kNormalDirection = 1e-4;

/// Default of --balance-tol: largest force or torque residual of an imported packing with known forces, in
/// the internal unit.
inline constexpr double kBalance = 1e-6;

/// Loads of bodies that nothing fixed holds cancel if their sum is up to this, relative to their sizes.
inline constexpr double kCancellingLoads = 1e-9;

/// A fixed body takes a direction of force if its own is not perpendicular to it to this (radian).
inline constexpr double kFreeDirection = 1e-9;

/// The vectors of a cell are parallel if its area is up to this, relative to the product of their lengths.
inline constexpr double kFlatCell = 1e-6;

/// σ_xy and σ_yx of known forces are the same if they differ by up to this, relative to the stress.
inline constexpr double kSymmetricStress = 1e-9;

/// Bodies whose surfaces are further apart than this, relative to the sum of their radii, cannot push each
/// other.
inline constexpr double kPushingDistance = 0.1;

/// A component of a vector up to this, relative to its length, is printed as 0.
inline constexpr double kPrintedComponent = 1e-9;

/// Where a force may vary by less than this to both sides, relative to the internal unit of force, the
/// problem is solved in a unit next to the narrowest such interval.
inline constexpr double kNarrowBounds = 1e-3;

/// A share of a force is not taken for less than this (mg): that of a force that is 0 but for rounding.
inline constexpr double kLeastError = 1e-9;

/// Bounds of forces beyond this (mg) cost digits, of which an import warns.
inline constexpr double kFarBound = 1e5;

/// Half intervals of bounds of forces that agree to this, relative to them, are called one error.
inline constexpr double kSameError = 1e-6;

/// Lever arms that leave net torques up to this (mg) are taken for equally good.
inline constexpr double kAlikeLevers = 1e-12;

/// A disk lies at a side of the packing if it reaches to within this of the outermost one, relative to the
/// largest radius; used to tell whether walls are missing.
inline constexpr double kAtSide = 0.02;

/// A disk whose kinetic energy is above this (mg times its radius) is said to move.
inline constexpr double kMoving = 1e-6;

/// Tangential forces up to this, relative to the normal ones, are none.
inline constexpr double kNoTangentialForce = 1e-12;

// Dumps of LAMMPS and other codes.

/// Contact points of one wall: their normals differ by less than this (radian), and they lie this near to one
/// line (relative to the largest radius).
inline constexpr double kSameWall = 1e-4;

/// Two printings of one force agree to this, relative to it: six digits.
inline constexpr double kPrintedForce = 1e-5;

/// A force along z up to this, relative to the force in the plane, is rounding.
inline constexpr double kOutOfPlane = 1e-9;

/// Tangential parts of normal forces, and normal parts of tangential ones, are ignored silently up to this
/// (mg).
inline constexpr double kDiscardedForce = 1e-6;

// Rank, dimension and shape of the polytope.

/// A singular value of the dimensionless contact matrix below kRankReject · σ_max counts as zero; one between
/// kNoise and kRankAccept makes the rank ambiguous, and every result of that packing `imprecise`.
inline constexpr double kRankReject = 1e-13;
inline constexpr double kRankAccept = 1e-11;

/// A half-plane whose slack cannot exceed this (internal unit, relative to max(1, ‖F1‖∞)) anywhere in F holds
/// with equality everywhere (it lowers dim F); F is empty if some slack must be below minus this. Parts of a
/// packing may be this much lighter than the mean. Between this and kNoise the decision is doubtful, and
/// every result `imprecise`.
inline constexpr double kImplicitEquality = 1e-12;

/// Rounding level of dimensionless quantities of order one. A rejected singular value (relative to σ_max), an
/// implicit equality or a ray that is off by more than this is not clearly one. Rounding alone gives about
/// 1e-16 … 1e-15.
inline constexpr double kNoise = 1e-14;

/// Load (internal unit, relative to max(1, ‖F1‖∞)) that no contact forces balance, above which the packing
/// cannot stand.
inline constexpr double kUnbalancedLoad = 1e-10;

/// A multiplier of the interior point's linear program closes its half-plane above this, relative to the
/// largest multiplier.
inline constexpr double kClosingMultiplier = 1e-9;

/// An entry of a virtual motion up to this, relative to the largest, says that the disk is at rest.
inline constexpr double kMotionEntry = 1e-9;

/// Where rational arithmetic repeats a motion or a ray, an entry of the guess up to this (relative to the
/// largest, which is 1) is held at exactly 0.
inline constexpr double kExactZero = 1e-9;

/// By this much of it (of both the largest entry is 1) a ray that cannot be proven is moved towards the sum
/// of all rays: forces that it leaves alone then grow by far more than kExactZero, those that it lets grow
/// still do.
inline constexpr double kInwardShift = 1e-3;

/// An edge of a cone whose strength changes by up to this along an edge of the polytope is not coupled to it;
/// uncoupled parts are blocks.
inline constexpr double kCoupling = 1e-9;

/// Independent parts of a large polytope: how far a contact's strengths move along random directions of it,
/// relative to those of the analytic centre, and how far along those of other contacts, relative to that. Up
/// to the first it is rounding, above the second it is not; between them the number of parts is not told.
inline constexpr double kPartRounding = 1e-12;
inline constexpr double kPartClear = 1e-9;

/// A force component with a gradient up to this over a block (dimensionless) is determined.
inline constexpr double kConstantComponent = 1e-9;

/// An objective is unbounded if it grows by more than this per unit of Σx along a direction of the recession
/// cone (dimensionless).
inline constexpr double kRay = 1e-9;

/// Violation of the recession cone by a ray with Σx = 1 up to which it counts as one.
inline constexpr double kRayResidual = 1e-10;

/// A force of a ray up to this, relative to the largest, is told as 0.
inline constexpr double kRayEntry = 1e-9;

// Results.

/// Largest residual, relative to max(1, ‖F‖∞) in internal units, with which a recomputed vertex counts as
/// certified: equilibrium (‖cF + w‖∞), contact conditions (negative part of μR ± T, R) and wrong-signed
/// reduced costs.
inline constexpr double kPrimalResidual = 1e-10;
inline constexpr double kDualResidual = 1e-9;

/// How wide the enclosure of a certified value may be, relative to the larger of |value| and the load at its
/// contact (range/promise.h).
inline constexpr double kCertifiedWidth = 1e-6;

/// A range up to this wide (internal unit) is a point: no force has a relative position R*,
/// T* in it.
inline constexpr double kPointRange = 1e-9;

/// A force up to this (mg) is printed as 0; files have all digits.
inline constexpr double kPrintedZero = 1e-9;

// Linear programs and the search over their vertices.

/// GLPK's own feasibility and optimality tolerances. Its answer is only a proposal (a basis), from which we
/// recompute.
inline constexpr double kLpFeasibility = 1e-10;
inline constexpr double kLpOptimality = 1e-10;

/// Sign of a reduced cost (dimensionless): above −kReducedCost it counts as non-negative, so that the vertex
/// is optimal; up to kReducedCost as zero, so that the optimal face may be more than the vertex. Workable:
/// 1e-12 … 1e-7.
inline constexpr double kReducedCost = 1e-9;

/// Two values of one objective (internal unit, relative to max(1, |value|)) count as equal when it is asked
/// whether a vertex attains the optimum.
inline constexpr double kTie = 1e-10;

/// A state may be this much heavier (relative) than the lightest known one and still be judged as a candidate
/// for the canonical state.
inline constexpr double kHeavier = 1e-10;

/// An optimal face on which the generic functional varies by up to this (internal unit, relative to max(1,
/// |value|)) is a point.
inline constexpr double kPointFace = 1e-9;

/// An edge of the polytope up to this long (internal unit; unit: its direction for a slack of 1) is none: its
/// ends are one degenerate vertex.
inline constexpr double kPolytopeEdge = 1e-9;

/// A slack that falls by up to this along an edge of the polytope (per unit of the slack that is left) does
/// not limit its length.
inline constexpr double kLengthRate = 1e-9;

/// Dual feasible bases of one value that are looked at for its sensitivity; where there are more, it has
/// none.
inline constexpr int kMostDualBases = 64;
/// And it has none where the table of these bases has more entries: dimensions times further tight rows.
inline constexpr int kMostDualEntries = 20000;
/// Steps by which the rows with a positive reduced cost are found, at most.
inline constexpr int kMostDualSteps = 1000;

/// A contact whose relative velocity in a motion is up to this, relative to its largest entry (at least 1),
/// rests: forces there move no value, however large.
inline constexpr double kRestingContact = 1e-11;

/// An inequality whose slack changes by up to this along an edge of the polytope keeps holding with equality.
inline constexpr double kHeldRate = 1e-9;

/// From a point to a vertex: a slack that falls by up to this (relative to the length of the direction) does
/// not stop the way, and a guide whose projection is that short, relative to max(1, ‖guide‖), no longer
/// guides.
inline constexpr double kPurificationRate = 1e-11;

/// Of two stops on that way one is the nearer if it is so by more than this (relative); else the steeper one
/// is taken.
inline constexpr double kNearerStop = 1e-12;

// Pivoting.

/// A slack that falls by up to this along an edge of the polytope (per unit of the slack that is left) does
/// not stop a step.
inline constexpr double kStepRate = 1e-11;

/// In the paper's walk an inequality below this is active (its ε, internal unit). Workable: as kSliding.
inline constexpr double kActive = 1e-9;

/// The paper's walk goes to a neighbour if the objective's slope (dimensionless) and gain (relative to max(1,
/// |value|)) exceed these.
inline constexpr double kImprovingSlope = 1e-9;
inline constexpr double kImprovingGain = 1e-10;

/// The directions of the polytope's edges are computed anew where the pivot of a change is below this beside
/// the largest entry of the new row.
inline constexpr double kDirectionPivot = 1e-3;

/// The directions of the polytope's edges are lost where the smallest pivot of S_N is this small beside the
/// largest.
inline constexpr double kLostDirections = 1e-12;

/// The paper's start: a simulated state that misses the equations by more than this (internal unit, relative
/// to max(1, ‖x‖∞)) is not admissible.
inline constexpr double kSimulatedState = 1e-6;

/// … and a direction that should leave one active inequality and keep the others may miss that by this.
inline constexpr double kLeavingDirection = 1e-9;

/// Slacks may fall below 0 by this (internal unit) so that the ratio test can choose among rows (Harris,
/// Math. Program. 5, 1 (1973)).
inline constexpr double kHarris = 1e-10;

/// A step that gains up to this (internal unit) counts as stalled.
inline constexpr double kStalledGain = 1e-14;

/// A held face of which the tableau violates an inequality by more than this (internal unit) is not searched.
inline constexpr double kHeldSlack = 1e-9;

/// A held inequality that cannot be made active by a rate above this is a combination of others.
inline constexpr double kDependentRate = 1e-9;

/// Rounding of the tableau that is let pass (relative; see Tableau::error).
inline constexpr double kTableauError = 1e-11;

/// Entries of a pivot column up to this are rounding of a zero: their rows stay as they are.
inline constexpr double kTableauZero = 1e-14;

/// The pivots of an exchange of inequalities may not be this small beside the largest.
inline constexpr double kSingularExchange = 1e-11;

// Uniform sampling.

/// A sample may violate equilibrium and inequalities by this (internal unit, relative to max(1, ‖F‖∞)).
inline constexpr double kSampleResidual = 1e-10;

/// A component whose row of the body has a norm below this is determined (and its chain constant).
inline constexpr double kConstantRow = 1e-12;

/// A force with a standard deviation up to this (internal unit) is determined.
inline constexpr double kConstantForce = 1e-9;

/// The analytic centre is found once Newton's decrement is below this.
inline constexpr double kNewtonDecrement = 1e-9;

/// A relative position of 1 counts in the last bin of a histogram: this much less than 1.
inline constexpr double kLastBin = 1e-12;

/// Extremal states of two methods that differ by less than this (relative to max(1, ‖F‖), mg) are the same.
inline constexpr double kSameState = 1e-6;

/// A standard deviation of R up to this (mg) is that of a force that is determined: nothing is told as a
/// multiple of it.
inline constexpr double kComparable = 1e-6;

/// Bins of a histogram: as many as reach its end but for this part of a bin, and no narrower than
/// kNarrowestBin (unit of the values).
inline constexpr double kLastPartOfBin = 1e-9;
inline constexpr double kNarrowestBin = 1e-12;

// Verification.

/// Recomputed and stored numbers may differ by this, relative to max(1, |number|).
inline constexpr double kAgreement = 1e-12;

/// Ranges and sizes of F at several values of a load are known to this, relative to them, where they are held
/// against each other (AnalyzeOptions::gap is 1e-6 mg). Workable: 1e-6 … 1e-2.
inline constexpr double kStepAgreement = 1e-5;

/// The same for a sum over many states, for diagnostics of chains (sums over products of sums), for the mean
/// square of ‖F‖ (relative), and for a p-value (relative to p max(1, −ln p)).
inline constexpr double kSumAgreement = 1e-9;
inline constexpr double kDiagnosticAgreement = 1e-8;
inline constexpr double kSizeAgreement = 1e-11;
inline constexpr double kProbabilityAgreement = 1e-7;

/// Room for rounding in inequalities between stored numbers, relative to the larger of them.
inline constexpr double kRoundingRoom = 1e-9;

/// A smallest distance of states that least squares find again is the stored one to this, relative to it (at
/// least 1 mg): twice kDistanceGap.
inline constexpr double kDistanceAgain = 2e-3;

/// A number that is a count but for rounding (a percentage of a known number of states) is whole to this.
inline constexpr double kWholeCount = 1e-6;

/// A solution of perturb-and-resolve balances, and lies in the cones, to this (internal unit).
inline constexpr double kAcceptedSolution = 1e-9;

/// Forces that vary less than this among samples (relative to the largest force) have an order that rounding
/// decides: ranks are not compared.
inline constexpr double kRankableDeviation = 1e-6;

/// The affine hull of F, as the half-planes without slack at a point make it: slacks and lengths (relative to
/// the largest force) up to the first are rounding, above the second they are not; between them nothing is
/// concluded.
inline constexpr double kHullRounding = 1e-12;
inline constexpr double kHullClear = 1e-9;

/// The same where random vectors are projected on the hull, in other coordinates: lengths above this are not
/// rounding.
inline constexpr double kProjectedClear = 1e-6;

/// A force that moves at most this far along every unit direction within F is determined.
inline constexpr double kDeterminedForce = 1e-9;

/// A force is determined if its width is up to this, relative to the normal force at the analytic centre, or
/// to μ times that: the square of a width is a difference, and rounds to some 1e-16 of the square of the
/// force. Workable: 1e-7 … 1e-5; the smallest widths of forces that can vary are 1e-4 in piles of 1e4 disks.
inline constexpr double kDeterminedWidth = 1e-6;

/// How wide the proven interval of such a force may be, relative to max(1 mg, |force|).
inline constexpr double kDeterminedInterval = 1e-6;

/// The analytic centre and the widths that contacts are drawn by: imbalance and widths relative to the
/// largest force, and the distance to the centre over its ellipsoid.
inline constexpr double kDrawCentre = 1e-6;

/// A half-plane with up to this much slack (relative to the largest force) is tight at a state.
inline constexpr double kTightHalfPlane = 1e-9;

/// Distance of an objective's gradient (dimensionless) from the cone of the outward normals of the tight
/// half-planes, up to which the state is optimal.
inline constexpr double kOptimalityGap = 1e-9;
/// The same in packings of more than kMostForPrograms unknowns, where it is found by sparse least squares:
/// these leave up to 1e-8 at 1600 disks.
inline constexpr double kSparseOptimalityGap = 1e-7;
/// What those add to the diagonal of their normal equations, so that dependent rows do no harm.
inline constexpr double kOptimalityRidge = 1e-12;

/// A stored motion may be resisted by a contact with this power, and a stored ray (largest entry 1) miss
/// balance and contact conditions by this.
inline constexpr double kResistedMotion = 1e-9;
inline constexpr double kStoredRay = 1e-9;

/// Singular directions of verify's own contact matrix below this, relative to the largest pivot, are the
/// kernel.
inline constexpr double kRebuiltRank = 1e-12;

/// Nonnegative least squares: ends when no gradient exceeds this, relative to 1 + ‖b‖; a coefficient up to
/// kPassiveZero leaves the passive set.
inline constexpr double kPassiveGradient = 1e-12;
inline constexpr double kPassiveZero = 1e-15;

// Drawing.

/// Points nearer than this, relative to the diagonal of the picture, are one.
inline constexpr double kSamePoint = 1e-9;

/// A tick or a number of the series 1, 2, 5, 10, … may exceed its limit by this (relative).
inline constexpr double kLastTick = 1e-9;
inline constexpr double kRoundNumber = 1e-12;

// Simulation (libsim). Forces and energies in the world's units (libsim/world.h), of a polish in internal
// units. All but kSweepLoosening, kNormalShift, kCellSize and kWholeNumber are defaults of options.

/// A run is at rest once the kinetic energy per disk is below kRestEnergy and the forces balance to
/// kRestForce (contact dynamics) or kRestSpringForce (springs; rounding of the positions alone leaves about
/// 1e-7 where k = 1.2e6).
inline constexpr double kRestEnergy = 1e-12;
inline constexpr double kRestForce = 1e-4;
inline constexpr double kRestSpringForce = 1e-6;

/// Forces that change by more than this (mg) while a packing comes to rest, before gravity turns, are not
/// those that it was made with: polished forces differ by 1e-8 … 1e-4 mg from those of the simulator.
inline constexpr double kOtherForces = 1e-2;

/// Gauss–Seidel sweeps end when no force changes by more than this in one: rigid contacts; implicit damping
/// and forces on a frozen packing, whose steps are small.
inline constexpr double kSweepChange = 1e-6;
inline constexpr double kFineSweepChange = 1e-7;

/// … loosened, with implicit damping, to this fraction of the largest change of a force in the step before.
inline constexpr double kSweepLoosening = 1e-3;

/// Polish: a raw contact slides if μR − |T| ≤ kPolishSliding · max(R, 1), transmits force if R exceeds
/// kPolishTransmitting, and forces are balanced to kPolishResidual.
inline constexpr double kPolishSliding = 1e-9;
inline constexpr double kPolishTransmitting = 1e-9;
inline constexpr double kPolishResidual = 1e-12;

/// A polished state of perturb-and-resolve is accepted if it balances, and lies in the cones, to this.
inline constexpr double kAcceptedResidual = 1e-9;

/// Added to the diagonal of the normal equations A Aᵀ (of order one), so that rows that no contact balances
/// do not make them singular; refinement undoes it.
inline constexpr double kNormalShift = 1e-10;

/// A cell of the grid may be this much smaller than the largest disk (relative): rounding of a size that was
/// chosen to fit.
inline constexpr double kCellSize = 1e-14;

/// A disk of the grid may begin this much beyond a wall, relative to the size of the grid: rounding of both.
inline constexpr double kWallStart = 1e-12;

/// Where verify looks for no kernel (above kMostForPrograms unknowns), singular values of its contact matrix
/// below this, relative to its largest column, count as 0. Its square is well above rounding.
inline constexpr double kSparseRank = 1e-6;

/// What is added to the diagonal of a Schur complement, relative to its entries, because its rows may
/// depend on each other.
inline constexpr double kRebuiltLift = 1e-13;

/// A quotient this little below a whole number is that number.
inline constexpr double kWholeNumber = 1e-9;

/// Above this number of unknowns no matrix with a row an unknown is made dense.
inline constexpr int kMostForDense = 12000;

/// Sums over all equations or edges, from which verify bounds values by stored multipliers, are taken to be
/// right to this, relative to the sum of the sizes of their terms.
inline constexpr double kSumOfProof = 1e-14;

/// verify solves linear programs of its own, to check intervals, for packings of up to so many unknowns.
inline constexpr int kMostForPrograms = 3000;

// Interior point method (libindet/barrier).

/// A pivot of A D Aᵀ below this, relative to the diagonal entry that it was, is rounding, and becomes huge:
/// its row is left out of the step.
inline constexpr double kVanishingPivot = 1e-15;
inline constexpr double kHugePivot = 1e60;

/// The analytic centre is found when A x = b holds to this, relative to the largest strength (at least one
/// internal unit), and x_k (Aᵀ y)_k = 1 to this. It need not be exact: what is proven of it is proven of the
/// point as it is.
inline constexpr double kCentreBalance = 1e-10;
inline constexpr double kCentring = 1e-6;

/// Strengths beyond this (internal unit) on the way to the centre tell that there is none.
inline constexpr double kFarthestCentre = 1e14;

/// The homogeneous self-dual method ends where of each pair of strict complementarity one side is this many
/// times the other (strengths in units of ten times the largest load, velocities relative to about the
/// largest), and the mean product of the pairs has fallen to kSelfDualPath. Where rounding ends it sooner,
/// nothing is decided below kLeastSplit; above, what it proposes stands or falls by the state and the motion
/// themselves.
inline constexpr double kClearSplit = 1e6;
inline constexpr double kSelfDualPath = 1e-12;
inline constexpr double kLeastSplit = 1e3;

/// Weights of the least squares by which a motion is mended are no smaller than this, and no larger than its
/// inverse.
inline constexpr double kLeastWeight = 1e-7;

/// A state x > 0, or a ray, is one if the last step that mends A x = b changes no entry by more than this,
/// relative to the entry: then an exact one is near.
inline constexpr double kMendedState = 1e-6;

/// Under a mended motion with largest entry 1, a unit force along an edge that rests has up to the first
/// power, one along an edge that opens at least the second. The load does no work up to the first (relative
/// to the largest load, at least one internal unit), and some from the second on (relative to Σ|b_i y_i|).
/// Rounding makes 1e-16 … 1e-15. Between them nothing is decided.
inline constexpr double kRestingPower = 1e-13;
inline constexpr double kOpeningPower = 1e-9;

/// Two states count as states of largest and smallest value of a force if, together, they are proven to miss
/// these values by up to this, relative to the larger of them (at least 1 mg). The smallest distance of two
/// such states is known if it and its proven lower bound are up to the second apart, relative to it (at least
/// 1 mg). Typical are 1e-9 and 1e-5.
inline constexpr double kFaceShortage = 1e-6;
inline constexpr double kDistanceGap = 1e-3;

/// What is left of Aᵀ y + s = c becomes part of s if it is smaller than this share of it.
inline constexpr double kAbsorbedDualResidual = 1e-3;

/// Strengths and reduced costs of a basis are refined until the equations hold to this, relative to the
/// largest load or cost.
inline constexpr double kVertexRounding = 1e-13;
/// An entry of a direction along an edge of the polytope that is smaller than this stays as it is.
inline constexpr double kVertexPivot = 1e-7;
/// Steps from the basis that the interior point method proposes to the best one at most.
inline constexpr int kMostVertexSteps = 2000;

/// An objective whose gap has not fallen below this share of the smallest before, in so many iterations, is
/// given up with what it has.
inline constexpr double kProgress = 0.9;
inline constexpr int kIdleIterations = 15;

// Limits of loads.

/// Where loads take part that do not turn with gravity, the angle at which it is proven to stand and the one
/// at which it is proven to fall are this far apart (rad), or somewhat more. Workable: 1e-14 … 1e-6.
inline constexpr double kTilt = 1e-12;

/// A limit whose proven bounds are further apart than this, relative to the larger of it and 1, is undecided.
inline constexpr double kLimitWidth = 1e-8;

/// Under a motion with largest entry 1, a contact whose surfaces part, or slide, by less than this rests.
inline constexpr double kRestingRate = 1e-9;

/// Two loads whose directions, as unit vectors of all their numbers, differ by less than this are parallel.
inline constexpr double kParallelLoads = 1e-9;

/// The least strength that all edges of a relaxed problem can have (in the problem's unit) tells by its sign
/// whether the packing stands if its magnitude is above this, and the friction is multiplied by no more
/// than kFarFactor and no less than its inverse; else exact arithmetic tells. Workable: 1e-11 … 1e-6.
inline constexpr double kClearMargin = 1e-9;
inline constexpr double kFarFactor = 64;
/// Factors of friction that are looked at are at most the first and at least the second.
inline constexpr double kLargestFactor = 0x1p30;
inline constexpr double kSmallestFactor = 0x1p-40;

/// The infimum of the friction factor is enclosed to this, relative to it. Workable: 1e-14 … 1e-6.
inline constexpr double kFrictionFactor = 1e-12;

}  // namespace indet::tolerance
