#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "libindet/exact/body_motion.h"
#include "libindet/limit/limit_step.h"
#include "libindet/packing/force.h"
#include "libindet/packing/loads.h"

namespace indet {

/// What stops the load at one end of the admissible λ.
enum class LimitOutcome : std::uint8_t {
  kReached,   ///< at `value` some motion is not resisted any more
  kNever,     ///< no λ is too large: `ray` balances the change of the load alone
  kNoState,   ///< no λ at all has a state
  kUndecided  ///< neither could be proven
};
const char* to_string(LimitOutcome outcome);

/// One end of the λ for which A F = b + λ b_1 has a solution in K and within the bounds (scene units).
///
/// At a limit the load under which the packing stands and the motion that it cannot resist prove each other:
/// F is a state at λ = value, and y a motion with
///
///   y · A_k ≥ 0 for every edge k,   ± y · b_1 = −1,   ± y · b = value
///
/// so that for every state at any λ  0 ≤ y · A x = y · b + λ y · b_1. That motion is the **collapse
/// mechanism**, of associated sliding: where contacts slide they open by μ times as much. A real packing may
/// yield before this limit, never after.
struct LimitEnd {
  LimitOutcome outcome = LimitOutcome::kUndecided;
  double value = std::numeric_limits<double>::quiet_NaN();  ///< ±inf if never
  double lower = -std::numeric_limits<double>::infinity();  ///< the exact value lies between
  double upper = std::numeric_limits<double>::infinity();
  SceneForces forces;  ///< R_1, T_1, … at the limit; if never, the ray (largest entry 1). Empty if undecided
  /// The mechanism, largest entry 1; if no λ has a state, the motion that proves it. Empty matrices if never.
  exact::BodyMotion motion;
  int sliding = -1;           ///< M_s at the limit; a contact without force counts twice
  int non_transmitting = -1;  ///< contacts without force there
  int dim = -1;               ///< of the face of F that is left at the limit: 0 is one state; −1: not known
  bool has_one_mechanism = false;  ///< no other motion (but for its size)
  std::vector<LimitStep> steps;    ///< on the way there; empty where nobody went it (sampling/limit_walk.h)
};

struct LoadLimits {
  LimitEnd smallest, largest;

  /// It stands as it is, at λ = 0.
  bool stands() const { return contains(0); }
  /// Whether λ is proven to be admissible.
  bool contains(double lambda) const;
};

struct LimitOptions {
  /// Pivots of exact arithmetic from where linear programs ended, before a limit is left undecided.
  int most_pivots = 200;
  /// Work (exact::Work) for what is left of F at a limit that is degenerate.
  double face_work = 2e6;
};

/// Finds one end or both, by linear programs whose bases are proven, or mended, in rational arithmetic.
/// Preconditions: find_defect(packing) and defect_of(change, packing) are empty, the change is not zero. Both
/// must outlive this. To be used on one thread.
class LoadLimitFinder {
 public:
  LoadLimitFinder(const Packing& packing, const Loads& change, const LimitOptions& options = {});
  ~LoadLimitFinder();

  /// +1: the largest λ, −1: the smallest.
  LimitEnd find(int sign);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};
LoadLimits find_load_limits(const Packing& packing, const Loads& change, const LimitOptions& options = {});

}  // namespace indet
