#include <vector>

#include "libindet/lp/layout.h"

namespace indet {
namespace {

/// min offset·y over slopeᵀ y = −g, y ≥ 0: a row a dimension, a column an inequality. y are the multipliers
/// of the inequalities. At a vertex the d active columns are basic; a feasible vertex is dual feasible here.
class DualLayout : public Layout {
 public:
  explicit DualLayout(const SlopeView& view) : view_(view) {}

  std::unique_ptr<GlpkProblem> build() const override {
    auto problem = std::make_unique<GlpkProblem>(view_.dim(), view_.inequalities(), false);
    std::vector<GlpkProblem::Entry> entries;
    for (int k = 0; k < view_.inequalities(); ++k) {
      problem->bound_column(k, GlpkProblem::Bound::kLower, 0);
      problem->set_cost(k, view_.offset[k]);
      for (int j = 0; j < view_.dim(); ++j) {
        if (view_.slope(k, j) != 0) entries.push_back({j, k, view_.slope(k, j)});
      }
    }
    for (int j = 0; j < view_.dim(); ++j) problem->bound_row(j, GlpkProblem::Bound::kFixed, 0);
    problem->load(entries);
    return problem;
  }

  void set_objective(GlpkProblem& problem, const Objective& objective) override {
    for (int j = 0; j < view_.dim(); ++j)
      problem.bound_row(j, GlpkProblem::Bound::kFixed, -objective.along_z[j]);
  }

  void set_start(GlpkProblem& problem, std::span<const int> basis) const override {
    for (int j = 0; j < view_.dim(); ++j) problem.set_row_status(j, GlpkProblem::Status::kNonbasic);
    for (int k = 0; k < view_.inequalities(); ++k)
      problem.set_column_status(k, GlpkProblem::Status::kNonbasic);
    for (const int k : basis) problem.set_column_status(k, GlpkProblem::Status::kBasic);
  }

  void hold(GlpkProblem& problem, std::span<const int> held, bool on) const override {
    const auto bound = on ? GlpkProblem::Bound::kFree : GlpkProblem::Bound::kLower;
    for (const int k : held) problem.bound_column(k, bound, 0);
  }

  Basis read_basis(const GlpkProblem& problem) const override {
    Basis basis;
    for (int k = 0; k < view_.inequalities(); ++k) {
      if (problem.is_column_basic(k)) basis.push_back(k);
    }
    return basis;
  }

  GlpkProblem::Simplex warm_simplex() const override { return GlpkProblem::Simplex::kDual; }

  LpStatus interpret(GlpkProblem::Result result) const override {
    switch (result) {
      case GlpkProblem::Result::kOptimal:
        return LpStatus::kOptimal;
      case GlpkProblem::Result::kInfeasible:
        return LpStatus::kUnbounded;
      case GlpkProblem::Result::kUnbounded:
        return LpStatus::kInfeasible;
      default:
        return LpStatus::kFailed;
    }
  }

 private:
  const SlopeView& view_;
};

}  // namespace

std::unique_ptr<Layout> make_dual_layout(const SlopeView& view) { return std::make_unique<DualLayout>(view); }

}  // namespace indet
