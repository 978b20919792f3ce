#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "libindet/equilibrium/equilibrium_problem.h"
#include "libindet/lp/glpk_problem.h"
#include "libindet/lp/lp_solver.h"

namespace indet {

/// The largest or smallest λ with a state, by one linear program over the cone's edges:
///
///   max ± λ   subject to   A x − λ b_1 = b,   x ≥ 0,   λ free
///
/// with b_1 a right-hand side beside b, in multiples of its largest entry; where there is none, any state. As
/// everywhere, a basis is taken from GLPK, and no number. To be created, used and destroyed on one thread.
class LimitProgram {
 public:
  /// b_1 is the second right-hand side of the problem, if it has one; or the one given. The problem must
  /// outlive this.
  explicit LimitProgram(const EquilibriumProblem& problem, const LpOptions& options = {});
  LimitProgram(const EquilibriumProblem& problem, Eigen::VectorXd change, const LpOptions& options = {});

  /// Goes on with another problem of the same unknowns and equations, as with other coefficients of friction.
  void replace(const EquilibriumProblem& problem, Eigen::VectorXd change);

  struct Answer {
    LpStatus status = LpStatus::kFailed;
    std::vector<bool> basic;  ///< of each edge; of the last point that the simplex method saw
    bool lambda_is_basic = false;
    double lambda = 0;  ///< a hint, GLPK's own number, in multiples of b_1
  };
  /// `sign`: +1 the largest λ, −1 the smallest, 0 any state. A second question starts where the first one
  /// ended.
  Answer find(int sign);

 private:
  bool has_change() const { return change_.size() > 0; }
  void scale();
  void build();
  void load();
  LpStatus attempt(int rung);

  const EquilibriumProblem* problem_;
  LpOptions options_;
  Eigen::VectorXd change_;  ///< b_1 / scale_
  double scale_ = 1;
  std::unique_ptr<GlpkProblem> program_;
  bool has_basis_ = false;  ///< the program stands at a feasible point
};

}  // namespace indet
